# staffage-gen: from the scene file to POV-Ray scenes and label layers.
noinst_LIBRARIES += gen/libgen.a
gen_libgen_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(GEOGRAPHIC_CFLAGS) $(TINYGLTF_CFLAGS) $(ASSIMP_CFLAGS) \
  $(ERFA_CFLAGS) $(YAML_CFLAGS) $(JANSSON_CFLAGS)
gen_libgen_a_SOURCES = \
  %D%/light.c %D%/light.h \
  %D%/passes.c %D%/passes.h \
  %D%/receiver.c %D%/receiver.h \
  %D%/sdl.c %D%/sdl.h \
  %D%/entity.c %D%/entity.h %D%/ground.c %D%/ground.h \
  %D%/place.cpp %D%/place.h %D%/sun.c %D%/sun.h %D%/trace.h
gen_libgen_a_SOURCES += \
  %D%/nearest.c %D%/nearest.h %D%/scene.c %D%/scene.h %D%/scene_keys.c %D%/scene_keys.h \
  %D%/scene_pose.c %D%/scene_pose.h %D%/schema.c %D%/schema.h %D%/schema_words.c %D%/schema_words.h \
  %D%/yaml.c %D%/yaml.h
gen_libgen_a_SOURCES += %D%/material.h %D%/model.h %D%/texture.h
gen_libgen_a_SOURCES += \
  %D%/footprint.c %D%/footprint.h %D%/polygon.c %D%/polygon.h %D%/rays.c %D%/rays.h %D%/shape.c %D%/shape.h %D%/trace.c
gen_libgen_a_SOURCES += %D%/makefile.c %D%/makefile.h
GEN_LIBS = gen/libgen.a $(LIB_LIBS) $(GEOGRAPHIC_LIBS) $(TINYGLTF_LIBS) $(ASSIMP_LIBS) $(EMBREE_LIBS) $(ERFA_LIBS) $(YAML_LIBS)

