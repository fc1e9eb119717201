# What people type, and how frames run.
EXTRA_DIST += tests/tap.sh tests/run/same-dataset.sh tests/run/stand-in-gen tests/run/stand-in-post
EXTRA_PROGRAMS = tests/run/compare-changes tests/run/compare-frame tests/run/compare-masks tests/run/make-place tests/run/measure-hand tests/run/project-box \
  tests/run/same-pixels tests/run/write-makefile
CLEANFILES += $(EXTRA_PROGRAMS)
check_DATA = $(EXTRA_PROGRAMS)
tests_run_compare_changes_SOURCES = %D%/compare-changes.c
nodist_EXTRA_tests_run_compare_changes_SOURCES = dummy.cxx
tests_run_compare_changes_LDADD = $(LIB_LIBS)
tests_run_compare_frame_SOURCES = %D%/compare-frame.c
nodist_EXTRA_tests_run_compare_frame_SOURCES = dummy.cxx
tests_run_compare_frame_LDADD = $(LIB_LIBS)
tests_run_compare_masks_SOURCES = %D%/compare-masks.c
nodist_EXTRA_tests_run_compare_masks_SOURCES = dummy.cxx
tests_run_compare_masks_LDADD = $(LIB_LIBS)
tests_run_make_place_SOURCES = %D%/make-place.c
tests_run_make_place_LDADD = -lm
tests_run_measure_hand_SOURCES = %D%/measure-hand.c
nodist_EXTRA_tests_run_measure_hand_SOURCES = dummy.cxx
tests_run_measure_hand_LDADD = $(POST_LIBS)
tests_run_project_box_SOURCES = %D%/project-box.c
tests_run_project_box_LDADD = $(JANSSON_LIBS) -lm
tests_run_same_pixels_SOURCES = %D%/same-pixels.c
nodist_EXTRA_tests_run_same_pixels_SOURCES = dummy.cxx
tests_run_same_pixels_LDADD = $(LIB_LIBS)
tests_run_write_makefile_SOURCES = %D%/write-makefile.c
nodist_EXTRA_tests_run_write_makefile_SOURCES = dummy.cxx
tests_run_write_makefile_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/makefile.test
tests_gen_makefile_test_SOURCES = tests/gen/makefile.c tests/tap.h
nodist_EXTRA_tests_gen_makefile_test_SOURCES = dummy.cxx
tests_gen_makefile_test_LDADD = $(GEN_LIBS)

dist_check_SCRIPTS += tests/flight.sh tests/run.sh tests/pipeline.sh tests/man.sh tests/masks.sh tests/proving.sh

EXTRA_DIST += tests/bench.sh tests/bench/craig-1000x750-4.yaml tests/bench/craig-2000x1500-15.yaml \
  tests/bench/labels/craig-3840x2880-20.yaml
.PHONY: bench
bench: all tests/bench/place.bench tests/bench/resize.bench
	@top_srcdir='$(abs_top_srcdir)' top_builddir='$(abs_top_builddir)' $(srcdir)/tests/bench.sh

check_PROGRAMS += tests/proving/compare_picture.test
tests_proving_compare_picture_test_SOURCES = tests/proving/compare_picture.c tests/tap.h \
  scenes/proving-ground/compare_picture.c scenes/proving-ground/compare_picture.h
nodist_EXTRA_tests_proving_compare_picture_test_SOURCES = dummy.cxx
tests_proving_compare_picture_test_LDADD = $(LIB_LIBS)
check_PROGRAMS += tests/proving/place_mesh.test
tests_proving_place_mesh_test_SOURCES = tests/proving/place_mesh.c tests/tap.h \
  scenes/proving-ground/place_mesh.c scenes/proving-ground/place_mesh.h
nodist_EXTRA_tests_proving_place_mesh_test_SOURCES = dummy.cxx
tests_proving_place_mesh_test_LDADD = $(LIB_LIBS)
