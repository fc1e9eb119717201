check_PROGRAMS += tests/import/brighton.test
tests_import_brighton_test_SOURCES = %D%/brighton.c tests/tap.h
nodist_EXTRA_tests_import_brighton_test_SOURCES = dummy.cxx
tests_import_brighton_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/georeference.test
tests_import_georeference_test_SOURCES = %D%/georeference.c tests/tap.h
nodist_EXTRA_tests_import_georeference_test_SOURCES = dummy.cxx
tests_import_georeference_test_LDADD = $(IMPORT_LIBS)

check_PROGRAMS += tests/import/photo_facts.test
tests_import_photo_facts_test_SOURCES = %D%/photo_facts.c tests/tap.h
tests_import_photo_facts_test_CPPFLAGS = $(AM_CPPFLAGS) $(EXIF_CFLAGS)
nodist_EXTRA_tests_import_photo_facts_test_SOURCES = dummy.cxx
tests_import_photo_facts_test_LDADD = $(IMPORT_LIBS)
