# staffage-import: from what structure-from-motion tools know to a scene file.
noinst_LIBRARIES += import/libimport.a
import_libimport_a_CPPFLAGS = $(AM_CPPFLAGS) $(EXIF_CFLAGS)
import_libimport_a_SOURCES = \
  %D%/control_points.c %D%/control_points.h \
  %D%/georeference.h \
  %D%/georeference_distance.c \
  %D%/georeference_ties.c \
  %D%/gps_ties.c %D%/gps_ties.h \
  %D%/photo_facts.c %D%/photo_facts.h \
  %D%/reconstruction.h \
  %D%/similarity.c %D%/similarity.h \
  %D%/svd.c %D%/svd.h
IMPORT_LIBS = import/libimport.a $(LIB_LIBS) $(EXIF_LIBS)
