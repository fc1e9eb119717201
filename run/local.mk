# staffage: what people type; staffage-povray: one pass, confined.
noinst_LIBRARIES += run/librun.a
run_librun_a_CPPFLAGS = $(AM_CPPFLAGS) -DPOVRAY_PROGRAM='"$(POVRAY)"'
run_librun_a_SOURCES = %D%/confine.c %D%/confine.h %D%/pass.c %D%/pass.h
RUN_LIBS = run/librun.a lib/libstaffage.a

bin_PROGRAMS += staffage-povray
staffage_povray_SOURCES = %D%/main.c
staffage_povray_LDADD = $(RUN_LIBS)

bin_SCRIPTS += staffage
