# staffage-post: from passes and photograph to the dataset.
noinst_LIBRARIES += post/libpost.a
post_libpost_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(JANSSON_CFLAGS)
post_libpost_a_SOURCES = \
  %D%/depth.c %D%/depth.h \
  %D%/exposure.c %D%/exposure.h \
  %D%/input.c %D%/input.h \
  %D%/mask.c %D%/mask.h \
  %D%/morphology.cpp %D%/morphology.h \
  %D%/semantic.c %D%/semantic.h \
  %D%/transfer.h %D%/transfer_caught.c \
  %D%/transfer_alpha.c %D%/transfer_layers.c %D%/transfer_ratio.c %D%/transfer_threshold.c \
  %D%/window.c %D%/window.h
POST_LIBS = post/libpost.a $(LIB_LIBS)
