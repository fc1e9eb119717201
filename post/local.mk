# staffage-post: from passes and photograph to the dataset; staffage-stats: what is in it.
noinst_LIBRARIES += post/libpost.a
post_libpost_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(JANSSON_CFLAGS) $(JPEG_CFLAGS)
post_libpost_a_SOURCES = \
  %D%/before.c %D%/before.h \
  %D%/blacks.c %D%/blacks.h \
  %D%/compression.c %D%/compression.h \
  %D%/defocus.c %D%/defocus.h \
  %D%/depth.c %D%/depth.h \
  %D%/edge.c %D%/edge.h \
  %D%/flat.c %D%/flat.h \
  %D%/frame.c %D%/frame.h \
  %D%/frame_input.c %D%/frame_input.h \
  %D%/frame_list.c %D%/frame_list.h \
  %D%/grain.c %D%/grain.h %D%/grain_add.c %D%/grain_pressed.c \
  %D%/ground_light.c %D%/ground_light.h \
  %D%/hand.c %D%/hand.h %D%/hand_json.c \
  %D%/highlights.c %D%/highlights.h \
  %D%/input.c %D%/input.h \
  %D%/kernel.c %D%/kernel.h \
  %D%/layer.c %D%/layer.h \
  %D%/mask.c %D%/mask.h \
  %D%/mist.c %D%/mist.h \
  %D%/morphology.cpp %D%/morphology.h \
  %D%/motion.c %D%/motion.h \
  %D%/objects.c %D%/objects.h \
  %D%/optics.c %D%/optics.h \
  %D%/output.c %D%/output.h \
  %D%/resample.c %D%/resample.h \
  %D%/semantic.c %D%/semantic.h \
  %D%/sharpening.c %D%/sharpening.h \
  %D%/softness.c %D%/softness.h \
  %D%/spread.c %D%/spread.h \
  %D%/stats.c %D%/stats.h %D%/stats_text.c \
  %D%/step.c %D%/step.h \
  %D%/transfer.h %D%/transfer_caught.c \
  %D%/transfer_alpha.c %D%/transfer_layers.c %D%/transfer_ratio.c %D%/transfer_threshold.c \
  %D%/vignette.c %D%/vignette.h \
  %D%/window.c %D%/window.h
POST_LIBS = post/libpost.a $(LIB_LIBS) $(JPEG_LIBS)

bin_PROGRAMS += staffage-post
staffage_post_SOURCES = %D%/main.c
nodist_EXTRA_staffage_post_SOURCES = dummy.cxx
staffage_post_LDADD = $(POST_LIBS)
# It starts once a frame: libraries that it does not use are not loaded.
staffage_post_LDFLAGS = $(AM_LDFLAGS) -Wl,--as-needed

bin_PROGRAMS += staffage-stats
staffage_stats_SOURCES = %D%/stats_main.c
nodist_EXTRA_staffage_stats_SOURCES = dummy.cxx
staffage_stats_LDADD = $(POST_LIBS)
