# scenes: what runs from a fresh clone, and the models that it needs, which a program of ours makes.
noinst_PROGRAMS += scenes/models/make-models
scenes_models_make_models_SOURCES = \
  %D%/models/glb.c %D%/models/glb.h %D%/models/make-models.c %D%/models/mesh.c %D%/models/mesh.h \
  %D%/models/obj.c %D%/models/person.c %D%/models/sedan.c \
  %D%/models/skeleton.c %D%/models/skeleton.h %D%/models/walk.c %D%/models/walk.h
scenes_models_make_models_LDADD = lib/libstaffage.a -lm
EXTRA_DIST += %D%/models/README.md

OWN_MODELS = %D%/models/sedan.obj %D%/models/man-walking.obj %D%/models/man-standing.obj \
  %D%/models/woman-walking.obj %D%/models/woman-standing.obj
OWN_WALKERS = %D%/models/walker-man.glb %D%/models/walker-woman.glb
noinst_DATA = $(OWN_MODELS) $(OWN_WALKERS)
CLEANFILES += $(OWN_MODELS) $(OWN_MODELS:.obj=.mtl) $(OWN_WALKERS)
# One run makes them all; with the stamp, one run is what happens under make -j. The recipe that does
# nothing keeps automake's rule for Windows objects from compiling sedan.c into sedan.obj.
$(OWN_MODELS) $(OWN_WALKERS): %D%/models/made.stamp
	@:
%D%/models/made.stamp: scenes/models/make-models$(EXEEXT)
	$(AM_V_GEN)scenes/models/make-models$(EXEEXT) %D%/models && touch $@
CLEANFILES += %D%/models/made.stamp

EXTRA_DIST += %D%/brighton/scene.yaml %D%/demo/scene.yaml %D%/craig/sunny.yaml %D%/craig/wet.yaml %D%/craig/median.yaml
.PHONY: demo
demo: all
	@test -f $(srcdir)/%D%/demo/vtest.avi || { echo 'demo: %D%/demo/vtest.avi is missing: ./bootstrap fetches it' >&2; exit 1; }
	@test -f %D%/demo/scene.yaml || { $(MKDIR_P) %D%/demo && cp $(srcdir)/%D%/demo/scene.yaml $(srcdir)/%D%/demo/vtest.avi %D%/demo/; }
	./staffage run %D%/demo/scene.yaml -o out/demo
	@echo 'Look at out/demo/rgb/*.png, and at out/demo/semantic, instance and labels beside them.'
