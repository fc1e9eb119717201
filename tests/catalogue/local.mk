# Tests of staffage models.
check_PROGRAMS += tests/catalogue/guess.test
tests_catalogue_guess_test_SOURCES = %D%/guess.c %D%/solids.h tests/gen/model_files.h tests/tap.h
nodist_EXTRA_tests_catalogue_guess_test_SOURCES = dummy.cxx
tests_catalogue_guess_test_LDADD = $(CATALOGUE_LIBS)

check_PROGRAMS += tests/catalogue/inspect.test
tests_catalogue_inspect_test_SOURCES = %D%/inspect.c %D%/solids.h tests/gen/model_files.h tests/tap.h
nodist_EXTRA_tests_catalogue_inspect_test_SOURCES = dummy.cxx
tests_catalogue_inspect_test_LDADD = $(CATALOGUE_LIBS)

dist_check_SCRIPTS += %D%/models.sh
