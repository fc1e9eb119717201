# cast: the program that makes the models which come with Staffage, and the models, made in the folder models/.
noinst_PROGRAMS += staffage-cast
staffage_cast_CPPFLAGS = $(AM_CPPFLAGS) $(JANSSON_CFLAGS) $(ZLIB_CFLAGS)
staffage_cast_SOURCES = \
  %D%/body.c %D%/body.h \
  %D%/car.c %D%/car.h \
  %D%/cars.c \
  %D%/clothes.c \
  %D%/coach.c %D%/coach.h \
  %D%/coat.c %D%/coat.h \
  %D%/cycles.c \
  %D%/decimate.c \
  %D%/feet.c %D%/feet.h \
  %D%/field.c %D%/field.h \
  %D%/figure.c %D%/figure.h \
  %D%/fleet.c %D%/fleet.h \
  %D%/form.h \
  %D%/glb.c %D%/glb.h \
  %D%/head.c \
  %D%/hull.c %D%/hull.h \
  %D%/listing.c %D%/listing.h \
  %D%/main.c \
  %D%/motion.c %D%/motion.h \
  %D%/need.h \
  %D%/occupant.c %D%/occupant.h \
  %D%/outline.c %D%/outline.h \
  %D%/part.c %D%/part.h \
  %D%/people.c \
  %D%/person.h \
  %D%/pose.c %D%/pose.h \
  %D%/shell.c %D%/shell.h \
  %D%/shell_cut.c \
  %D%/shell_decimate.c \
  %D%/shell_region.c \
  %D%/skin_glb.c %D%/skin_glb.h \
  %D%/surface_net.c %D%/surface_net.h \
  %D%/texture.c %D%/texture.h \
  %D%/trucks.c \
  %D%/vehicle.h \
  %D%/vehicle_glb.c \
  %D%/wheel.c %D%/wheel.h \
  %D%/workshop.c %D%/workshop.h
staffage_cast_LDADD = lib/libstaffage.a $(JANSSON_LIBS) $(ZLIB_LIBS) -lm -lpthread
EXTRA_DIST += %D%/README.md

# What it makes is listed in the catalogue, and made in one run; make install takes what the run left. What fails half-way
# leaves no catalogue that looks done.
noinst_DATA = models/catalogue.json
models/catalogue.json: staffage-cast$(EXEEXT)
	$(AM_V_GEN)rm -rf models models.part && $(MAKE_MODELS) models.part && mv models.part models
modelsdir = $(pkgdatadir)/models
install-data-local: models/catalogue.json
	$(MKDIR_P) '$(DESTDIR)$(modelsdir)' && $(INSTALL_DATA) models/* '$(DESTDIR)$(modelsdir)'
uninstall-local:
	rm -rf '$(DESTDIR)$(modelsdir)'
clean-local:
	rm -rf models models.part
