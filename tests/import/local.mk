check_PROGRAMS += tests/import/brighton.test
tests_import_brighton_test_SOURCES = %D%/brighton.c tests/tap.h
nodist_EXTRA_tests_import_brighton_test_SOURCES = dummy.cxx
tests_import_brighton_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/colmap.test
tests_import_colmap_test_SOURCES = %D%/colmap.c %D%/scratch.h tests/tap.h
nodist_EXTRA_tests_import_colmap_test_SOURCES = dummy.cxx
tests_import_colmap_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/georeference.test
tests_import_georeference_test_SOURCES = %D%/georeference.c tests/tap.h
nodist_EXTRA_tests_import_georeference_test_SOURCES = dummy.cxx
tests_import_georeference_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/nerfstudio.test
tests_import_nerfstudio_test_SOURCES = %D%/nerfstudio.c %D%/refusals.h %D%/scratch.h tests/tap.h
nodist_EXTRA_tests_import_nerfstudio_test_SOURCES = dummy.cxx
tests_import_nerfstudio_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/opensfm.test
tests_import_opensfm_test_SOURCES = %D%/opensfm.c %D%/refusals.h %D%/scratch.h tests/tap.h
nodist_EXTRA_tests_import_opensfm_test_SOURCES = dummy.cxx
tests_import_opensfm_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/photo_facts.test
tests_import_photo_facts_test_SOURCES = %D%/photo_facts.c tests/tap.h
tests_import_photo_facts_test_CPPFLAGS = $(AM_CPPFLAGS) $(EXIF_CFLAGS)
nodist_EXTRA_tests_import_photo_facts_test_SOURCES = dummy.cxx
tests_import_photo_facts_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/scene.test
tests_import_scene_test_SOURCES = %D%/scene.c %D%/scratch.h tests/tap.h
nodist_EXTRA_tests_import_scene_test_SOURCES = dummy.cxx
tests_import_scene_test_LDADD = import/libimport.a $(GEN_LIBS) $(EXIF_LIBS)
dist_check_SCRIPTS += tests/import.sh %D%/positions.sh
