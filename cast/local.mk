# cast: the program that makes the models which come with Staffage, and the models, made in the folder models/.
noinst_PROGRAMS += staffage-cast
staffage_cast_CPPFLAGS = $(AM_CPPFLAGS) $(JANSSON_CFLAGS)
staffage_cast_SOURCES = \
  %D%/glb.c %D%/glb.h \
  %D%/listing.c %D%/listing.h \
  %D%/main.c \
  %D%/mesh.c %D%/mesh.h \
  %D%/obj.c \
  %D%/person.c \
  %D%/sedan.c \
  %D%/skeleton.c %D%/skeleton.h \
  %D%/walk.c %D%/walk.h
staffage_cast_LDADD = lib/libstaffage.a $(JANSSON_LIBS) -lm
EXTRA_DIST += %D%/README.md

# What it makes is listed in the catalogue, and made in one run; make install takes what the run left.
noinst_DATA = models/catalogue.json
models/catalogue.json: staffage-cast$(EXEEXT)
	$(AM_V_GEN)rm -rf models && ./staffage-cast$(EXEEXT) models
modelsdir = $(pkgdatadir)/models
install-data-local: models/catalogue.json
	$(MKDIR_P) '$(DESTDIR)$(modelsdir)' && $(INSTALL_DATA) models/* '$(DESTDIR)$(modelsdir)'
uninstall-local:
	rm -rf '$(DESTDIR)$(modelsdir)'
clean-local:
	rm -rf models
