# proving-ground: a street of our own whose truth is known, and how near the tool comes to it (docs/fidelity.md).
noinst_PROGRAMS += scenes/proving-ground/proving-ground
scenes_proving_ground_proving_ground_CPPFLAGS = $(AM_CPPFLAGS) $(JANSSON_CFLAGS)
scenes_proving_ground_proving_ground_SOURCES = \
  %D%/cases.c %D%/cases.h \
  %D%/color_place.c %D%/color_place.h \
  %D%/compare.c %D%/compare.h \
  %D%/compare_hand.c %D%/compare_hand.h \
  %D%/compare_picture.c %D%/compare_picture.h \
  %D%/develop.c %D%/develop.h \
  %D%/influence.c %D%/influence.h \
  %D%/main.c \
  %D%/map_flight.c %D%/map_flight.h \
  %D%/picture.c %D%/picture.h \
  %D%/pinhole.c %D%/pinhole.h \
  %D%/place_heights.c %D%/place_heights.h \
  %D%/place_mesh.c %D%/place_mesh.h \
  %D%/reconstruct.c %D%/reconstruct.h \
  %D%/table.c \
  %D%/write_outlines.c %D%/write_outlines.h \
  %D%/write_pov.c %D%/write_pov.h \
  %D%/write_scene.c %D%/write_scene.h
nodist_EXTRA_scenes_proving_ground_proving_ground_SOURCES = dummy.cxx
scenes_proving_ground_proving_ground_LDADD = $(POST_LIBS)
EXTRA_DIST += %D%/light_proving.inc %D%/prove %D%/settings_proving.inc %D%/street.inc %D%/street_materials.inc \
  %D%/street_matter.inc
.PHONY: proving
proving: all
	$(srcdir)/%D%/prove
