# Checks of staffage-post's modules.
check_PROGRAMS += tests/post/labels.test
tests_post_labels_test_SOURCES = %D%/labels.c tests/tap.h
nodist_EXTRA_tests_post_labels_test_SOURCES = dummy.cxx
tests_post_labels_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/mask.test
tests_post_mask_test_SOURCES = %D%/mask.c tests/tap.h
nodist_EXTRA_tests_post_mask_test_SOURCES = dummy.cxx
tests_post_mask_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/transfer_alpha.test
tests_post_transfer_alpha_test_SOURCES = %D%/transfer_alpha.c tests/tap.h
nodist_EXTRA_tests_post_transfer_alpha_test_SOURCES = dummy.cxx
tests_post_transfer_alpha_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/transfer_layers.test
tests_post_transfer_layers_test_SOURCES = %D%/transfer_layers.c tests/tap.h
nodist_EXTRA_tests_post_transfer_layers_test_SOURCES = dummy.cxx
tests_post_transfer_layers_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/transfer_ratio.test
tests_post_transfer_ratio_test_SOURCES = %D%/transfer_ratio.c tests/tap.h
nodist_EXTRA_tests_post_transfer_ratio_test_SOURCES = dummy.cxx
tests_post_transfer_ratio_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/transfer_threshold.test
tests_post_transfer_threshold_test_SOURCES = %D%/transfer_threshold.c tests/tap.h
nodist_EXTRA_tests_post_transfer_threshold_test_SOURCES = dummy.cxx
tests_post_transfer_threshold_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/frame.test
tests_post_frame_test_SOURCES = %D%/frame.c tests/tap.h
nodist_EXTRA_tests_post_frame_test_SOURCES = dummy.cxx
tests_post_frame_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/input.test
tests_post_input_test_SOURCES = %D%/input.c tests/tap.h
nodist_EXTRA_tests_post_input_test_SOURCES = dummy.cxx
tests_post_input_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/resample.test
tests_post_resample_test_SOURCES = %D%/resample.c tests/tap.h
nodist_EXTRA_tests_post_resample_test_SOURCES = dummy.cxx
tests_post_resample_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/marker.test
tests_post_marker_test_SOURCES = %D%/marker.c tests/tap.h
nodist_EXTRA_tests_post_marker_test_SOURCES = dummy.cxx
tests_post_marker_test_LDADD = post/libpost.a $(GEN_LIBS)

check_PROGRAMS += tests/post/mist.test
tests_post_mist_test_SOURCES = %D%/mist.c %D%/layers.h tests/tap.h
nodist_EXTRA_tests_post_mist_test_SOURCES = dummy.cxx
tests_post_mist_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/motion.test
tests_post_motion_test_SOURCES = %D%/motion.c %D%/layers.h tests/tap.h
nodist_EXTRA_tests_post_motion_test_SOURCES = dummy.cxx
tests_post_motion_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/defocus.test
tests_post_defocus_test_SOURCES = %D%/defocus.c %D%/layers.h tests/tap.h
nodist_EXTRA_tests_post_defocus_test_SOURCES = dummy.cxx
tests_post_defocus_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/softness.test
tests_post_softness_test_SOURCES = %D%/softness.c %D%/layers.h tests/tap.h
nodist_EXTRA_tests_post_softness_test_SOURCES = dummy.cxx
tests_post_softness_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/before.test
tests_post_before_test_SOURCES = %D%/before.c tests/tap.h
nodist_EXTRA_tests_post_before_test_SOURCES = dummy.cxx
tests_post_before_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/stats.test
tests_post_stats_test_SOURCES = %D%/stats.c tests/tap.h
nodist_EXTRA_tests_post_stats_test_SOURCES = dummy.cxx
tests_post_stats_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/spread.test
tests_post_spread_test_SOURCES = %D%/spread.c %D%/layers.h tests/tap.h
nodist_EXTRA_tests_post_spread_test_SOURCES = dummy.cxx
tests_post_spread_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/compression.test
tests_post_compression_test_SOURCES = %D%/compression.c %D%/taken.h tests/tap.h
nodist_EXTRA_tests_post_compression_test_SOURCES = dummy.cxx
tests_post_compression_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/edge.test
tests_post_edge_test_SOURCES = %D%/edge.c %D%/taken.h tests/tap.h
nodist_EXTRA_tests_post_edge_test_SOURCES = dummy.cxx
tests_post_edge_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/grain.test
tests_post_grain_test_SOURCES = %D%/grain.c %D%/taken.h tests/tap.h
nodist_EXTRA_tests_post_grain_test_SOURCES = dummy.cxx
tests_post_grain_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/blacks.test
tests_post_blacks_test_SOURCES = %D%/blacks.c %D%/taken.h tests/tap.h
nodist_EXTRA_tests_post_blacks_test_SOURCES = dummy.cxx
tests_post_blacks_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/highlights.test
tests_post_highlights_test_SOURCES = %D%/highlights.c %D%/taken.h tests/tap.h
nodist_EXTRA_tests_post_highlights_test_SOURCES = dummy.cxx
tests_post_highlights_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/vignette.test
tests_post_vignette_test_SOURCES = %D%/vignette.c %D%/taken.h tests/tap.h
nodist_EXTRA_tests_post_vignette_test_SOURCES = dummy.cxx
tests_post_vignette_test_LDADD = $(POST_LIBS)

check_PROGRAMS += tests/post/sharpening.test
tests_post_sharpening_test_SOURCES = %D%/sharpening.c %D%/taken.h tests/tap.h
nodist_EXTRA_tests_post_sharpening_test_SOURCES = dummy.cxx
tests_post_sharpening_test_LDADD = $(POST_LIBS)
