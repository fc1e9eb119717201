TEST_LOG_DRIVER = env AM_TAP_AWK='$(AWK)' $(SHELL) $(top_srcdir)/build-aux/tap-driver.sh
SH_LOG_DRIVER = $(TEST_LOG_DRIVER)
LOG_DRIVER = $(TEST_LOG_DRIVER)
TEST_EXTENSIONS = .sh
AM_TESTS_ENVIRONMENT = top_srcdir='$(abs_top_srcdir)' top_builddir='$(abs_top_builddir)'; export top_srcdir top_builddir;
EXTRA_DIST += %D%/tap.h

# Unit tests, one program a module. Each links C++ through the shims.
check_PROGRAMS += tests/lib/class.test
tests_lib_class_test_SOURCES = %D%/lib/class.c %D%/tap.h
nodist_EXTRA_tests_lib_class_test_SOURCES = dummy.cxx
tests_lib_class_test_LDADD = $(LIB_LIBS)

check_PROGRAMS += tests/lib/air.test
tests_lib_air_test_SOURCES = %D%/lib/air.c %D%/tap.h
nodist_EXTRA_tests_lib_air_test_SOURCES = dummy.cxx
tests_lib_air_test_LDADD = $(LIB_LIBS)

check_PROGRAMS += tests/lib/photograph.test
tests_lib_photograph_test_SOURCES = %D%/lib/photograph.c %D%/tap.h
nodist_EXTRA_tests_lib_photograph_test_SOURCES = dummy.cxx
tests_lib_photograph_test_LDADD = $(LIB_LIBS)

check_PROGRAMS += tests/lib/vec.test
tests_lib_vec_test_SOURCES = %D%/lib/vec.c %D%/tap.h
nodist_EXTRA_tests_lib_vec_test_SOURCES = dummy.cxx
tests_lib_vec_test_LDADD = $(LIB_LIBS)

check_PROGRAMS += tests/lib/rle.test
tests_lib_rle_test_SOURCES = %D%/lib/rle.c %D%/tap.h
nodist_EXTRA_tests_lib_rle_test_SOURCES = dummy.cxx
tests_lib_rle_test_LDADD = $(LIB_LIBS)

check_PROGRAMS += tests/lib/camera.test
tests_lib_camera_test_SOURCES = %D%/lib/camera.c %D%/tap.h
nodist_EXTRA_tests_lib_camera_test_SOURCES = dummy.cxx
tests_lib_camera_test_LDADD = $(LIB_LIBS)

check_PROGRAMS += tests/lib/tsai.test
tests_lib_tsai_test_SOURCES = %D%/lib/tsai.c %D%/tap.h
nodist_EXTRA_tests_lib_tsai_test_SOURCES = dummy.cxx
tests_lib_tsai_test_LDADD = $(LIB_LIBS)
check_PROGRAMS += tests/gen/scene.test
tests_gen_scene_test_SOURCES = %D%/gen/scene.c %D%/tap.h
nodist_EXTRA_tests_gen_scene_test_SOURCES = dummy.cxx
tests_gen_scene_test_LDADD = $(GEN_LIBS)
EXTRA_DIST += %D%/input %D%/invalid
dist_check_SCRIPTS += %D%/invalid.sh

check_PROGRAMS += tests/gen/scenes.test
tests_gen_scenes_test_SOURCES = %D%/gen/scenes.c %D%/tap.h
nodist_EXTRA_tests_gen_scenes_test_SOURCES = dummy.cxx
tests_gen_scenes_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/ground.test
tests_gen_ground_test_SOURCES = %D%/gen/ground.c %D%/tap.h
nodist_EXTRA_tests_gen_ground_test_SOURCES = dummy.cxx
tests_gen_ground_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/ground_shade.test
tests_gen_ground_shade_test_SOURCES = %D%/gen/ground_shade.c %D%/gen/craig.h %D%/gen/place.h %D%/gen/street.h %D%/gen/view_above.h %D%/tap.h
nodist_EXTRA_tests_gen_ground_shade_test_SOURCES = dummy.cxx
tests_gen_ground_shade_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/enclosed.test
tests_gen_enclosed_test_SOURCES = %D%/gen/enclosed.c %D%/gen/place.h %D%/tap.h
nodist_EXTRA_tests_gen_enclosed_test_SOURCES = dummy.cxx
tests_gen_enclosed_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/entity.test
tests_gen_entity_test_SOURCES = %D%/gen/entity.c %D%/tap.h
nodist_EXTRA_tests_gen_entity_test_SOURCES = dummy.cxx
tests_gen_entity_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/lib/place.test
tests_lib_place_test_SOURCES = %D%/lib/place.c %D%/tap.h
nodist_EXTRA_tests_lib_place_test_SOURCES = dummy.cxx
tests_lib_place_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/ribbon.test
tests_gen_ribbon_test_SOURCES = %D%/gen/ribbon.c %D%/tap.h
nodist_EXTRA_tests_gen_ribbon_test_SOURCES = dummy.cxx
tests_gen_ribbon_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/place_sdl.test
tests_gen_place_sdl_test_SOURCES = %D%/gen/place_sdl.c %D%/gen/place.h %D%/gen/povray.h %D%/gen/shade.h %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_place_sdl_test_SOURCES = dummy.cxx
tests_gen_place_sdl_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/plane_depth.test
tests_gen_plane_depth_test_SOURCES = %D%/gen/plane_depth.c %D%/tap.h
nodist_EXTRA_tests_gen_plane_depth_test_SOURCES = dummy.cxx
tests_gen_plane_depth_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/road.test
tests_gen_road_test_SOURCES = %D%/gen/road.c %D%/tap.h
nodist_EXTRA_tests_gen_road_test_SOURCES = dummy.cxx
tests_gen_road_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/sunlit.test
tests_gen_sunlit_test_SOURCES = %D%/gen/sunlit.c %D%/gen/place.h %D%/tap.h
nodist_EXTRA_tests_gen_sunlit_test_SOURCES = dummy.cxx
tests_gen_sunlit_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/estimate.test
tests_gen_estimate_test_SOURCES = %D%/gen/estimate.c %D%/gen/craig.h %D%/gen/place.h %D%/gen/street.h %D%/tap.h
nodist_EXTRA_tests_gen_estimate_test_SOURCES = dummy.cxx
tests_gen_estimate_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/shade.test
tests_gen_shade_test_SOURCES = %D%/gen/shade.c %D%/tap.h
nodist_EXTRA_tests_gen_shade_test_SOURCES = dummy.cxx
tests_gen_shade_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/north.test
tests_gen_north_test_SOURCES = %D%/gen/north.c %D%/gen/craig.h %D%/tap.h
nodist_EXTRA_tests_gen_north_test_SOURCES = dummy.cxx
tests_gen_north_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/exposure.test
tests_gen_exposure_test_SOURCES = %D%/gen/exposure.c %D%/tap.h
nodist_EXTRA_tests_gen_exposure_test_SOURCES = dummy.cxx
tests_gen_exposure_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/orthophoto.test
tests_gen_orthophoto_test_SOURCES = %D%/gen/orthophoto.c %D%/gen/place.h %D%/gen/solid.h %D%/gen/view_above.h %D%/tap.h
nodist_EXTRA_tests_gen_orthophoto_test_SOURCES = dummy.cxx
tests_gen_orthophoto_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/bounced.test
tests_gen_bounced_test_SOURCES = %D%/gen/bounced.c %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_bounced_test_SOURCES = dummy.cxx
tests_gen_bounced_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/panorama.test
tests_gen_panorama_test_SOURCES = %D%/gen/panorama.c %D%/gen/place.h %D%/gen/view_above.h %D%/tap.h
nodist_EXTRA_tests_gen_panorama_test_SOURCES = dummy.cxx
tests_gen_panorama_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/standing.test
tests_gen_standing_test_SOURCES = %D%/gen/standing.c %D%/gen/view_above.h %D%/tap.h
nodist_EXTRA_tests_gen_standing_test_SOURCES = dummy.cxx
tests_gen_standing_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/relief.test
tests_gen_relief_test_SOURCES = %D%/gen/relief.c %D%/gen/place.h %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_relief_test_SOURCES = dummy.cxx
tests_gen_relief_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/hidden_place.test
tests_gen_hidden_place_test_SOURCES = %D%/gen/hidden_place.c %D%/gen/place.h %D%/tap.h
nodist_EXTRA_tests_gen_hidden_place_test_SOURCES = dummy.cxx
tests_gen_hidden_place_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/push_pull.test
tests_gen_push_pull_test_SOURCES = %D%/gen/push_pull.c %D%/tap.h
nodist_EXTRA_tests_gen_push_pull_test_SOURCES = dummy.cxx
tests_gen_push_pull_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/surroundings_light_povray.test
tests_gen_surroundings_light_povray_test_SOURCES = %D%/gen/surroundings_light_povray.c %D%/gen/ball.h %D%/gen/place.h %D%/gen/povray.h %D%/gen/solid.h %D%/gen/view_above.h %D%/tap.h
nodist_EXTRA_tests_gen_surroundings_light_povray_test_SOURCES = dummy.cxx
tests_gen_surroundings_light_povray_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/surroundings_povray.test
tests_gen_surroundings_povray_test_SOURCES = %D%/gen/surroundings_povray.c %D%/gen/ball.h %D%/gen/place.h %D%/gen/povray.h %D%/gen/solid.h %D%/gen/view_above.h %D%/tap.h
nodist_EXTRA_tests_gen_surroundings_povray_test_SOURCES = dummy.cxx
tests_gen_surroundings_povray_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/surface.test
tests_gen_surface_test_SOURCES = %D%/gen/surface.c %D%/tap.h
nodist_EXTRA_tests_gen_surface_test_SOURCES = dummy.cxx
tests_gen_surface_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/surroundings.test
tests_gen_surroundings_test_SOURCES = %D%/gen/surroundings.c %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_surroundings_test_SOURCES = dummy.cxx
tests_gen_surroundings_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/sun.test
tests_gen_sun_test_SOURCES = %D%/gen/sun.c %D%/tap.h
nodist_EXTRA_tests_gen_sun_test_SOURCES = dummy.cxx
tests_gen_sun_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/lib/view.test
tests_lib_view_test_SOURCES = %D%/lib/view.c %D%/tap.h
nodist_EXTRA_tests_lib_view_test_SOURCES = dummy.cxx
tests_lib_view_test_LDADD = $(LIB_LIBS)
check_PROGRAMS += tests/gen/daylight.test
tests_gen_daylight_test_SOURCES = %D%/gen/daylight.c %D%/tap.h
nodist_EXTRA_tests_gen_daylight_test_SOURCES = dummy.cxx
tests_gen_daylight_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/light.test
tests_gen_light_test_SOURCES = %D%/gen/light.c %D%/tap.h
nodist_EXTRA_tests_gen_light_test_SOURCES = dummy.cxx
tests_gen_light_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/measured_sky.test
tests_gen_measured_sky_test_SOURCES = %D%/gen/measured_sky.c %D%/tap.h
nodist_EXTRA_tests_gen_measured_sky_test_SOURCES = dummy.cxx
tests_gen_measured_sky_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/skyline.test
tests_gen_skyline_test_SOURCES = %D%/gen/skyline.c %D%/tap.h
nodist_EXTRA_tests_gen_skyline_test_SOURCES = dummy.cxx
tests_gen_skyline_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/wet_ground.test
tests_gen_wet_ground_test_SOURCES = %D%/gen/wet_ground.c %D%/gen/povray.h %D%/gen/shade.h %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_wet_ground_test_SOURCES = dummy.cxx
tests_gen_wet_ground_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/sent_back_povray.test
tests_gen_sent_back_povray_test_SOURCES = %D%/gen/sent_back_povray.c %D%/gen/povray.h %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_sent_back_povray_test_SOURCES = dummy.cxx
tests_gen_sent_back_povray_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/sky_rays.test
tests_gen_sky_rays_test_SOURCES = %D%/gen/sky_rays.c %D%/gen/place.h %D%/tap.h
nodist_EXTRA_tests_gen_sky_rays_test_SOURCES = dummy.cxx
tests_gen_sky_rays_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/sky_povray.test
tests_gen_sky_povray_test_SOURCES = %D%/gen/sky_povray.c %D%/gen/povray.h %D%/tap.h
nodist_EXTRA_tests_gen_sky_povray_test_SOURCES = dummy.cxx
tests_gen_sky_povray_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/sdl.test
tests_gen_sdl_test_SOURCES = %D%/gen/sdl.c %D%/tap.h
nodist_EXTRA_tests_gen_sdl_test_SOURCES = dummy.cxx
tests_gen_sdl_test_LDADD = $(GEN_LIBS)


check_PROGRAMS += tests/lib/manifest.test
tests_lib_manifest_test_SOURCES = %D%/lib/manifest.c %D%/tap.h
nodist_EXTRA_tests_lib_manifest_test_SOURCES = dummy.cxx
tests_lib_manifest_test_LDADD = $(LIB_LIBS)

check_PROGRAMS += tests/gen/passes.test
tests_gen_passes_test_SOURCES = %D%/gen/passes.c %D%/gen/shade.h %D%/gen/povray.h %D%/tap.h
nodist_EXTRA_tests_gen_passes_test_SOURCES = dummy.cxx
tests_gen_passes_test_LDADD = $(GEN_LIBS)
check_PROGRAMS += tests/gen/casting.test
tests_gen_casting_test_SOURCES = %D%/gen/casting.c %D%/gen/model_files.h %D%/tap.h
nodist_EXTRA_tests_gen_casting_test_SOURCES = dummy.cxx
tests_gen_casting_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/cast/people.test
tests_cast_people_test_SOURCES = %D%/cast/people.c %D%/cast/surface.h %D%/gen/tread.h %D%/tap.h
nodist_EXTRA_tests_cast_people_test_SOURCES = dummy.cxx
tests_cast_people_test_LDADD = $(GEN_LIBS)
check_PROGRAMS += tests/cast/vehicles.test
tests_cast_vehicles_test_SOURCES = %D%/cast/surface.h %D%/cast/vehicles.c %D%/tap.h
nodist_EXTRA_tests_cast_vehicles_test_SOURCES = dummy.cxx
tests_cast_vehicles_test_LDADD = $(GEN_LIBS)

dist_check_SCRIPTS += %D%/cast/cast.sh

check_PROGRAMS += tests/gen/catalogue.test
tests_gen_catalogue_test_SOURCES = %D%/gen/catalogue.c %D%/gen/model_files.h %D%/tap.h
nodist_EXTRA_tests_gen_catalogue_test_SOURCES = dummy.cxx
tests_gen_catalogue_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/gait.test
tests_gen_gait_test_SOURCES = %D%/gen/gait.c %D%/gen/model_files.h %D%/gen/tread.h %D%/gen/walker_files.h %D%/tap.h
nodist_EXTRA_tests_gen_gait_test_SOURCES = dummy.cxx
tests_gen_gait_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/model.test
tests_gen_model_test_SOURCES = %D%/gen/model.c %D%/gen/model_files.h %D%/tap.h
nodist_EXTRA_tests_gen_model_test_SOURCES = dummy.cxx
tests_gen_model_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/model_gltf.test
tests_gen_model_gltf_test_SOURCES = %D%/gen/model_gltf.c %D%/gen/model_files.h %D%/tap.h
nodist_EXTRA_tests_gen_model_gltf_test_SOURCES = dummy.cxx
tests_gen_model_gltf_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/model_ply.test
tests_gen_model_ply_test_SOURCES = %D%/gen/model_ply.c %D%/gen/model_files.h %D%/tap.h
nodist_EXTRA_tests_gen_model_ply_test_SOURCES = dummy.cxx
tests_gen_model_ply_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/model_texture.test
tests_gen_model_texture_test_SOURCES = %D%/gen/model_texture.c %D%/gen/model_files.h %D%/tap.h
nodist_EXTRA_tests_gen_model_texture_test_SOURCES = dummy.cxx
tests_gen_model_texture_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/repertoire.test
tests_gen_repertoire_test_SOURCES = %D%/gen/model_files.h %D%/gen/repertoire.c %D%/gen/walker_files.h %D%/tap.h
nodist_EXTRA_tests_gen_repertoire_test_SOURCES = dummy.cxx
tests_gen_repertoire_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/rig.test
tests_gen_rig_test_SOURCES = %D%/gen/rig.c %D%/gen/model_files.h %D%/gen/rig_table.h %D%/gen/walker_files.h %D%/tap.h
nodist_EXTRA_tests_gen_rig_test_SOURCES = dummy.cxx
tests_gen_rig_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/material.test
tests_gen_material_test_SOURCES = %D%/gen/material.c %D%/tap.h
nodist_EXTRA_tests_gen_material_test_SOURCES = dummy.cxx
tests_gen_material_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/texture.test
tests_gen_texture_test_SOURCES = %D%/gen/texture.c %D%/tap.h
nodist_EXTRA_tests_gen_texture_test_SOURCES = dummy.cxx
tests_gen_texture_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/polygon.test
tests_gen_polygon_test_SOURCES = %D%/gen/polygon.c %D%/tap.h
nodist_EXTRA_tests_gen_polygon_test_SOURCES = dummy.cxx
tests_gen_polygon_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/moment.test
tests_gen_moment_test_SOURCES = %D%/gen/moment.c %D%/gen/model_files.h %D%/gen/tread.h %D%/gen/walker_files.h %D%/tap.h
nodist_EXTRA_tests_gen_moment_test_SOURCES = dummy.cxx
tests_gen_moment_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/trace.test
tests_gen_trace_test_SOURCES = %D%/gen/trace.c %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_trace_test_SOURCES = dummy.cxx
tests_gen_trace_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/trace_place.test
tests_gen_trace_place_test_SOURCES = %D%/gen/trace_place.c %D%/gen/place.h %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_trace_place_test_SOURCES = dummy.cxx
tests_gen_trace_place_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/motion.test
tests_gen_motion_test_SOURCES = %D%/gen/motion.c %D%/gen/place.h %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_motion_test_SOURCES = dummy.cxx
tests_gen_motion_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/trace_povray.test
tests_gen_trace_povray_test_SOURCES = %D%/gen/trace_povray.c %D%/gen/place.h %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_trace_povray_test_SOURCES = dummy.cxx
tests_gen_trace_povray_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/label.test
tests_gen_label_test_SOURCES = %D%/gen/label.c %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_label_test_SOURCES = dummy.cxx
tests_gen_label_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/lib/draw.test
tests_lib_draw_test_SOURCES = %D%/lib/draw.c %D%/tap.h
nodist_EXTRA_tests_lib_draw_test_SOURCES = dummy.cxx
tests_lib_draw_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/path.test
tests_gen_path_test_SOURCES = %D%/gen/path.c %D%/tap.h
nodist_EXTRA_tests_gen_path_test_SOURCES = dummy.cxx
tests_gen_path_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/shaded_ground.test
tests_gen_shaded_ground_test_SOURCES = %D%/gen/shaded_ground.c %D%/gen/solid.h %D%/tap.h
nodist_EXTRA_tests_gen_shaded_ground_test_SOURCES = dummy.cxx
tests_gen_shaded_ground_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/wet.test
tests_gen_wet_test_SOURCES = %D%/gen/wet.c %D%/tap.h
nodist_EXTRA_tests_gen_wet_test_SOURCES = dummy.cxx
tests_gen_wet_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/sun_blockers.test
tests_gen_sun_blockers_test_SOURCES = %D%/gen/sun_blockers.c %D%/tap.h
nodist_EXTRA_tests_gen_sun_blockers_test_SOURCES = dummy.cxx
tests_gen_sun_blockers_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/shade_povray.test
tests_gen_shade_povray_test_SOURCES = %D%/gen/shade_povray.c %D%/gen/povray.h %D%/gen/shade.h %D%/gen/solid.h %D%/gen/view_above.h %D%/tap.h
nodist_EXTRA_tests_gen_shade_povray_test_SOURCES = dummy.cxx
tests_gen_shade_povray_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/shading.test
tests_gen_shading_test_SOURCES = %D%/gen/shading.c %D%/tap.h
nodist_EXTRA_tests_gen_shading_test_SOURCES = dummy.cxx
tests_gen_shading_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/static_mesh.test
tests_gen_static_mesh_test_SOURCES = %D%/gen/static_mesh.c %D%/tap.h
nodist_EXTRA_tests_gen_static_mesh_test_SOURCES = dummy.cxx
tests_gen_static_mesh_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/traffic.test
tests_gen_traffic_test_SOURCES = %D%/gen/traffic.c %D%/tap.h
nodist_EXTRA_tests_gen_traffic_test_SOURCES = dummy.cxx
tests_gen_traffic_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/frame.test
tests_gen_frame_test_SOURCES = %D%/gen/frame.c %D%/tap.h
nodist_EXTRA_tests_gen_frame_test_SOURCES = dummy.cxx
tests_gen_frame_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/fusion.test
tests_gen_fusion_test_SOURCES = %D%/gen/fusion.c %D%/tap.h
nodist_EXTRA_tests_gen_fusion_test_SOURCES = dummy.cxx
tests_gen_fusion_test_LDADD = $(GEN_LIBS)

check_PROGRAMS += tests/gen/place.test
tests_gen_place_test_SOURCES = %D%/gen/place.c %D%/tap.h
nodist_EXTRA_tests_gen_place_test_SOURCES = dummy.cxx
tests_gen_place_test_LDADD = $(GEN_LIBS)

# make bench runs them.
EXTRA_PROGRAMS += tests/bench/place.bench tests/bench/resize.bench
tests_bench_place_bench_SOURCES = %D%/bench/place.c
nodist_EXTRA_tests_bench_place_bench_SOURCES = dummy.cxx
tests_bench_place_bench_LDADD = $(GEN_LIBS)
tests_bench_resize_bench_SOURCES = %D%/bench/resize.c
nodist_EXTRA_tests_bench_resize_bench_SOURCES = dummy.cxx
tests_bench_resize_bench_LDADD = $(LIB_LIBS)

# Scripts first: some take minutes, and what is short fills up the other cores beside them.
TESTS += $(dist_check_SCRIPTS) $(check_PROGRAMS)
