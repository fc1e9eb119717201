# staffage-models: the catalogue of models, listed and added to.
noinst_LIBRARIES += catalogue/libcatalogue.a
catalogue_libcatalogue_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(JANSSON_CFLAGS)
catalogue_libcatalogue_a_SOURCES = \
  %D%/add.c %D%/add.h \
  %D%/folder.c %D%/folder.h \
  %D%/front.c %D%/front.h \
  %D%/guess.c %D%/guess.h \
  %D%/inspect.c %D%/inspect.h \
  %D%/list.c %D%/list.h \
  %D%/parts.c %D%/parts.h \
  %D%/portrait.c %D%/portrait.h \
  %D%/sheet.cpp %D%/sheet.h
CATALOGUE_LIBS = catalogue/libcatalogue.a $(GEN_LIBS)

bin_PROGRAMS += staffage-models
staffage_models_CPPFLAGS = $(AM_CPPFLAGS) -DPKGDATADIR='"$(pkgdatadir)"'
staffage_models_SOURCES = %D%/main.c
nodist_EXTRA_staffage_models_SOURCES = dummy.cxx
staffage_models_LDADD = $(CATALOGUE_LIBS)
