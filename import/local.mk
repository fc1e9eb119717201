# staffage-import: from what structure-from-motion tools know to a scene file.
noinst_LIBRARIES += import/libimport.a
import_libimport_a_CPPFLAGS = $(AM_CPPFLAGS) $(EXIF_CFLAGS) $(JANSSON_CFLAGS)
import_libimport_a_SOURCES = \
  %D%/colmap.c \
  %D%/colmap_binary.c \
  %D%/colmap_records.c %D%/colmap_records.h \
  %D%/colmap_text.c \
  %D%/control_points.c %D%/control_points.h \
  %D%/focal.c %D%/focal.h \
  %D%/georeference.h \
  %D%/georeference_distance.c \
  %D%/georeference_ties.c \
  %D%/gps_ties.c %D%/gps_ties.h \
  %D%/nerfstudio.c \
  %D%/opensfm.c \
  %D%/path_from.c %D%/path_from.h \
  %D%/photo_facts.c %D%/photo_facts.h \
  %D%/photographs.c %D%/photographs.h \
  %D%/placement.c %D%/placement.h \
  %D%/reconstruction.c %D%/reconstruction.h \
  %D%/scene_yaml.c %D%/scene_yaml.h \
  %D%/similarity.c %D%/similarity.h \
  %D%/svd.c %D%/svd.h
IMPORT_LIBS = import/libimport.a $(LIB_LIBS) $(EXIF_LIBS)

bin_PROGRAMS += staffage-import
staffage_import_SOURCES = %D%/main.c
nodist_EXTRA_staffage_import_SOURCES = dummy.cxx
staffage_import_LDADD = $(IMPORT_LIBS)
