# cast: the program that makes the models which come with Staffage, and the models, made in the folder models/.
noinst_PROGRAMS += staffage-cast
staffage_cast_SOURCES = \
  %D%/glb.c %D%/glb.h \
  %D%/main.c \
  %D%/mesh.c %D%/mesh.h \
  %D%/obj.c \
  %D%/person.c \
  %D%/sedan.c \
  %D%/skeleton.c %D%/skeleton.h \
  %D%/walk.c %D%/walk.h
staffage_cast_LDADD = lib/libstaffage.a -lm
EXTRA_DIST += %D%/README.md

OWN_MODELS = models/sedan.obj models/man-walking.obj models/man-standing.obj \
  models/woman-walking.obj models/woman-standing.obj
OWN_WALKERS = models/walker-man.glb models/walker-woman.glb
noinst_DATA = $(OWN_MODELS) $(OWN_WALKERS)
CLEANFILES += $(OWN_MODELS) $(OWN_MODELS:.obj=.mtl) $(OWN_WALKERS)
# One run makes them all; with the stamp, one run is what happens under make -j. The recipe that does
# nothing keeps automake's rule for Windows objects from compiling sedan.c into sedan.obj.
$(OWN_MODELS) $(OWN_WALKERS): models/made.stamp
	@:
models/made.stamp: staffage-cast$(EXEEXT)
	$(AM_V_GEN)./staffage-cast$(EXEEXT) models && touch $@
CLEANFILES += models/made.stamp
