# What gen and post share.
noinst_LIBRARIES += lib/libstaffage.a
lib_libstaffage_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(GEOGRAPHIC_CFLAGS) $(JANSSON_CFLAGS)
lib_libstaffage_a_SOURCES = \
  %D%/air.c %D%/air.h \
  %D%/class.c %D%/class.h \
  %D%/draw.c %D%/draw.h \
  %D%/error.c %D%/error.h \
  %D%/file.c %D%/file.h \
  %D%/image.c %D%/image.h %D%/image_io.cpp \
  %D%/json_file.c %D%/json_file.h \
  %D%/json_walk.c %D%/json_walk.h \
  %D%/luminance.h \
  %D%/opencv.h \
  %D%/photograph.c %D%/photograph.h \
  %D%/place.cpp %D%/place.h \
  %D%/rect.h \
  %D%/rle.c %D%/rle.h \
  %D%/vec.c %D%/vec.h \
  %D%/video_io.cpp \
  %D%/camera.c %D%/camera.h \
  %D%/view.c %D%/view.h %D%/manifest.c %D%/manifest.h
LIB_LIBS = lib/libstaffage.a $(OPENCV_LIBS) $(GEOGRAPHIC_LIBS) $(JANSSON_LIBS) -lm
