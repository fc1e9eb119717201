# staffage-gen: from the scene file to POV-Ray scenes and label layers.
noinst_LIBRARIES += gen/libgen.a
gen_libgen_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(GEOGRAPHIC_CFLAGS) $(TINYGLTF_CFLAGS) $(ASSIMP_CFLAGS) \
  $(ERFA_CFLAGS) $(YAML_CFLAGS) $(JANSSON_CFLAGS)
gen_libgen_a_SOURCES = \
  %D%/camera_sdl.c %D%/camera_sdl.h \
  %D%/entity.c %D%/entity.h \
  %D%/footprint.c %D%/footprint.h \
  %D%/gltf.cpp %D%/gltf.h \
  %D%/frame.c %D%/frame.h \
  %D%/ground.c %D%/ground.h \
  %D%/label.c %D%/label.h \
  %D%/light.c %D%/light.h \
  %D%/makefile.c %D%/makefile.h \
  %D%/material.c %D%/material.h \
  %D%/mesh.c %D%/mesh.h \
  %D%/model.c %D%/model.h \
  %D%/model_assimp.c \
  %D%/model_gltf.c \
  %D%/model_import.c %D%/model_import.h \
  %D%/model_ply.c \
  %D%/model_texture.c %D%/model_texture.h \
  %D%/nearest.c %D%/nearest.h \
  %D%/paint.c %D%/paint.h \
  %D%/passes.c %D%/passes.h \
  %D%/place.cpp %D%/place.h \
  %D%/polygon.c %D%/polygon.h \
  %D%/rays.c %D%/rays.h \
  %D%/receiver.c %D%/receiver.h \
  %D%/scene.c %D%/scene.h \
  %D%/scene_keys.c %D%/scene_keys.h \
  %D%/scene_pose.c %D%/scene_pose.h \
  %D%/schema.c %D%/schema.h \
  %D%/schema_words.c %D%/schema_words.h \
  %D%/screen.c %D%/screen.h \
  %D%/sdl.c %D%/sdl.h \
  %D%/shape.c %D%/shape.h \
  %D%/sun.c %D%/sun.h \
  %D%/texture.c %D%/texture.h \
  %D%/trace.c %D%/trace.h \
  %D%/yaml.c %D%/yaml.h
GEN_LIBS = gen/libgen.a $(LIB_LIBS) $(GEOGRAPHIC_LIBS) $(TINYGLTF_LIBS) $(ASSIMP_LIBS) $(EMBREE_LIBS) $(ERFA_LIBS) $(YAML_LIBS)


bin_PROGRAMS += staffage-gen
staffage_gen_CPPFLAGS = $(AM_CPPFLAGS) -DPKGDATADIR='"$(pkgdatadir)"'
staffage_gen_SOURCES = %D%/main.c
nodist_EXTRA_staffage_gen_SOURCES = dummy.cxx
staffage_gen_LDADD = $(GEN_LIBS)
