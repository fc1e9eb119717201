# staffage-gen: from the scene file to POV-Ray scenes and label layers.
noinst_LIBRARIES += gen/libgen.a
gen_libgen_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(TINYGLTF_CFLAGS) $(ASSIMP_CFLAGS) \
  $(ERFA_CFLAGS) $(YAML_CFLAGS) $(JANSSON_CFLAGS) $(READOSM_CFLAGS)
gen_libgen_a_SOURCES = \
  %D%/detail.c %D%/detail.h \
  %D%/estimate/daylight_locus.c %D%/estimate/daylight_locus.h \
  %D%/estimate/estimate.c %D%/estimate/estimate.h %D%/estimate/estimate_impl.h \
  %D%/estimate/estimate_gather.c \
  %D%/estimate/estimate_report.c \
  %D%/estimate/ground_shade.c %D%/estimate/ground_shade.h \
  %D%/estimate/ground_view.c %D%/estimate/ground_view.h \
  %D%/estimate/lit_ground.c %D%/estimate/lit_ground.h \
  %D%/estimate/shade.c %D%/estimate/shade.h \
  %D%/estimate/shadow_edges.c %D%/estimate/shadow_edges.h \
  %D%/estimate/sun_check.c %D%/estimate/sun_check.h \
  %D%/estimate/sun_share.c %D%/estimate/sun_share.h \
  %D%/estimate/tones.c %D%/estimate/tones.h \
  %D%/frame.c %D%/frame.h %D%/frame_impl.h \
  %D%/frame_exposure.c \
  %D%/frame_manifest.c \
  %D%/frame_passes.c \
  %D%/frame_surroundings.c \
  %D%/generator.c %D%/generator.h \
  %D%/light/daylight.c %D%/light/daylight.h \
  %D%/light/enclosed.c %D%/light/enclosed.h \
  %D%/light/exposure.c %D%/light/exposure.h \
  %D%/light/light.c %D%/light/light.h \
  %D%/light/map_sun.c %D%/light/map_sun.h \
  %D%/light/measured_sky.c %D%/light/measured_sky.h \
  %D%/light/orthophoto.c %D%/light/orthophoto.h \
  %D%/light/panorama.c %D%/light/panorama.h \
  %D%/light/push_pull.c %D%/light/push_pull.h \
  %D%/light/hidden_place.c %D%/light/hidden_place.h \
  %D%/light/relief.c %D%/light/relief.h \
  %D%/light/seen.c %D%/light/seen.h \
  %D%/light/sky_form.c %D%/light/sky_form.h \
  %D%/light/sky_image.h \
  %D%/light/skyline.c %D%/light/skyline.h \
  %D%/light/standing.c %D%/light/standing.h \
  %D%/light/sun.c %D%/light/sun.h \
  %D%/light/unhidden.c %D%/light/unhidden.h \
  %D%/light/wet.c %D%/light/wet.h \
  %D%/model/affine.c %D%/model/affine.h \
  %D%/model/catalogue.c %D%/model/catalogue.h \
  %D%/model/catalogue_folders.c \
  %D%/model/gltf.cpp %D%/model/gltf.h \
  %D%/model/gltf_accessor.c \
  %D%/model/gltf_material.c \
  %D%/model/gltf_rig.c \
  %D%/model/material.c %D%/model/material.h \
  %D%/model/mesh.c %D%/model/mesh.h \
  %D%/model/model.c %D%/model/model.h \
  %D%/model/model_assimp.c \
  %D%/model/model_gltf.c %D%/model/model_gltf.h \
  %D%/model/model_import.c %D%/model/model_import.h \
  %D%/model/model_ply.c \
  %D%/model/model_texture.c %D%/model/model_texture.h \
  %D%/model/number.c %D%/model/number.h \
  %D%/model/paint.c %D%/model/paint.h \
  %D%/model/ply.c %D%/model/ply.h \
  %D%/model/rig.c %D%/model/rig.h \
  %D%/model/texture.c %D%/model/texture.h \
  %D%/motion/crossing.c %D%/motion/crossing.h \
  %D%/motion/crowd.c %D%/motion/crowd.h \
  %D%/moment.c %D%/moment.h \
  %D%/sighting.c %D%/sighting.h \
  %D%/motion/drive.c \
  %D%/motion/gait.c %D%/motion/gait.h \
  %D%/motion/journey.c %D%/motion/journey.h \
  %D%/motion/repertoire.c %D%/motion/repertoire.h \
  %D%/motion/population.c %D%/motion/population.h \
  %D%/motion/track.c %D%/motion/track.h \
  %D%/motion/traffic.c %D%/motion/traffic.h \
  %D%/motion/walk.c \
  %D%/render/camera_sdl.c %D%/render/camera_sdl.h \
  %D%/render/makefile.c %D%/render/makefile.h \
  %D%/render/mesh_sdl.c %D%/render/mesh_sdl.h \
  %D%/render/model_sdl.c %D%/render/model_sdl.h \
  %D%/render/passes.c %D%/render/passes.h \
  %D%/render/place_sdl.c %D%/render/place_sdl.h \
  %D%/render/sdl.c %D%/render/sdl.h \
  %D%/render/shade_sdl.c %D%/render/shade_sdl.h \
  %D%/render/sky_uv.c %D%/render/sky_uv.h \
  %D%/run_json.c %D%/run_json.h \
  %D%/scene/nearest.c %D%/scene/nearest.h \
  %D%/scene/scene.c %D%/scene/scene.h \
  %D%/scene/scene_cast.c \
  %D%/scene/scene_choice.c \
  %D%/scene/scene_keys.c %D%/scene/scene_keys.h \
  %D%/scene/scene_light.c \
  %D%/scene/scene_north.c \
  %D%/scene/scene_pose.c %D%/scene/scene_pose.h \
  %D%/scene/scene_place.c \
  %D%/scene/scene_read.h \
  %D%/scene/scene_shots.c \
  %D%/scene/scene_traffic.c \
  %D%/scene/schema.c %D%/scene/schema.h %D%/scene/schema_hash.c \
  %D%/scene/schema_words.c %D%/scene/schema_words.h \
  %D%/scene/yaml.c %D%/scene/yaml.h \
  %D%/shutter.c %D%/shutter.h \
  %D%/stage.c %D%/stage.h \
  %D%/stage_cast.c %D%/stage_cast.h \
  %D%/trace/backdrop.c %D%/trace/backdrop.h \
  %D%/trace/bounced.c %D%/trace/bounced.h \
  %D%/trace/cast.c %D%/trace/cast.h \
  %D%/sunlit.c %D%/sunlit.h \
  %D%/trace/exitance.c %D%/trace/exitance.h \
  %D%/trace/footprint.c %D%/trace/footprint.h \
  %D%/trace/fusion.c %D%/trace/fusion.h \
  %D%/trace/label.c %D%/trace/label.h \
  %D%/trace/shaded_ground.c %D%/trace/shaded_ground.h \
  %D%/trace/motion.c %D%/trace/motion.h \
  %D%/trace/place.c %D%/trace/place.h \
  %D%/trace/plane_depth.c %D%/trace/plane_depth.h \
  %D%/trace/polygon.c %D%/trace/polygon.h \
  %D%/trace/rays.c %D%/trace/rays.h \
  %D%/trace/screen.c %D%/trace/screen.h \
  %D%/trace/semantic.c %D%/trace/semantic.h \
  %D%/trace/shape.c %D%/trace/shape.h \
  %D%/trace/share.c %D%/trace/share.h \
  %D%/trace/sky_rays.c %D%/trace/sky_rays.h \
  %D%/trace/sky_sight.c %D%/trace/sky_sight.h \
  %D%/trace/sunlit_ground.c %D%/trace/sunlit_ground.h \
  %D%/trace/trace.c %D%/trace/trace.h \
  %D%/world/banded.c %D%/world/banded.h \
  %D%/world/cut_rays.c %D%/world/cut_rays.h \
  %D%/world/entity.c %D%/world/entity.h \
  %D%/world/ground.c %D%/world/ground.h \
  %D%/world/osm.c %D%/world/osm.h \
  %D%/world/path.c %D%/world/path.h \
  %D%/world/prism.c %D%/world/prism.h \
  %D%/world/receiver.c %D%/world/receiver.h \
  %D%/world/ribbon.c %D%/world/ribbon.h \
  %D%/world/ribbon_fit.c \
  %D%/world/ribbon_lay.c \
  %D%/world/road.c %D%/world/road.h \
  %D%/world/road_tags.c %D%/world/road_tags.h \
  %D%/world/shading.c %D%/world/shading.h \
  %D%/world/static_color.c \
  %D%/world/static_cut.c \
  %D%/world/static_mesh.c %D%/world/static_mesh.h %D%/world/static_mesh_impl.h \
  %D%/world/static_mesh_add.c \
  %D%/world/static_mesh_obj.c \
  %D%/world/static_mesh_ply.c \
  %D%/world/static_mesh_rays.c \
  %D%/world/static_mesh_write.c \
  %D%/world/strip.c %D%/world/strip.h \
  %D%/world/sun_blockers.c %D%/world/sun_blockers.h \
  %D%/world/surface.c %D%/world/surface.h \
  %D%/world/surroundings.c %D%/world/surroundings.h
GEN_LIBS = gen/libgen.a $(LIB_LIBS) $(TINYGLTF_LIBS) $(ASSIMP_LIBS) $(EMBREE_LIBS) $(ERFA_LIBS) $(YAML_LIBS) $(READOSM_LIBS)


bin_PROGRAMS += staffage-gen
staffage_gen_CPPFLAGS = $(AM_CPPFLAGS) -DPKGDATADIR='"$(pkgdatadir)"'
staffage_gen_SOURCES = %D%/main.c
nodist_EXTRA_staffage_gen_SOURCES = dummy.cxx
staffage_gen_LDADD = $(GEN_LIBS)

bin_PROGRAMS += staffage-fuse
staffage_fuse_CPPFLAGS = $(AM_CPPFLAGS) -DPKGDATADIR='"$(pkgdatadir)"'
staffage_fuse_SOURCES = %D%/fuse_main.c
nodist_EXTRA_staffage_fuse_SOURCES = dummy.cxx
staffage_fuse_LDADD = $(GEN_LIBS)
