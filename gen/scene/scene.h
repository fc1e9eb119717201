/* A scene: what the user's YAML file says, checked, in our units. docs/scene.md
 * describes every key; the table in scene_keys.c is what that page is tested against.
 *
 * Every pixel position in a scene is in pixels of the shot's camera, as the file gives it: a photograph
 * of another size, or a reduced one, has them scaled with the camera. */
#ifndef STAFFAGE_GEN_SCENE_H
#define STAFFAGE_GEN_SCENE_H

#include "gen/world/entity.h"
#include "gen/world/ground.h"
#include "gen/world/road.h"
#include "gen/model/catalogue.h"
#include "gen/model/model.h"
#include "gen/light/sun.h"
#include "gen/light/wet.h"
#include "lib/camera.h"
#include "lib/class.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where in the scene file something stands, for errors that are found later. */
struct source { int line, column; };

enum place_kind { PLACE_WORLD, PLACE_GEODETIC, PLACE_PIXEL };

/* A model under `models`, or one of the catalogue that something asks for. */
struct scene_model {
    char *name;
    char *files[DETAIL_COUNT]; /* resolved paths, as in the catalogue; one under `models` has the first only */
    struct model_options options; /* rules are filled in later */
    bool has_class;
    enum entity_class class_;
    struct model_color *colors; /* (color_count) that it is seen in */
    size_t color_count;
    struct source source;
};

/* One model, or several of which one is drawn. */
struct scene_choice {
    size_t *models;            /* (count) indices into scene.models */
    double *weights;
    size_t count;
};

struct scene_camera { char *name; struct camera camera; struct source source; }; /* at the size that it was given for */

/* One frame of the result. */
struct scene_shot {
    int number;                /* names the frame; of a video, the frame there */
    char *photograph;          /* resolved path; NULL: a frame of the video, or a new view of the static mesh */
    size_t camera;
    struct pose world_from_camera;
    double time_s;             /* after the scene's time */
    char *semantic, *depth;    /* resolved paths of images that belong to the photograph, or NULL */
    struct source source;
};

/* The place as mesh. */
struct scene_static {
    char *mesh;                /* resolved path; NULL: the ground is a plane */
    struct similarity world_from_mesh;
    double detail_m;
    struct source source;
};

/* A road or footway by hand. */
struct scene_path {
    char *name;
    enum road_use use;
    enum place_kind place;
    struct vec2 *points;       /* (n) WORLD: x, y m · GEODETIC: latitude, longitude deg · PIXEL: px of the shot */
    size_t n, shot;
    double width_m;
    bool oneway;
    struct source source;
};

/* Vehicles or people that come by themselves. */
struct scene_movers {
    size_t count;              /* 0: none */
    struct scene_choice choice;
    double speed_m_s;
    double (*colors)[3];       /* (color_count) linear */
    size_t color_count;
    struct source source;
};

struct scene_entity {
    char *name;
    struct scene_choice choice;
    bool has_class;            /* else its class is its model's */
    enum entity_class class_;
    enum place_kind place;
    double at[3];              /* WORLD: x, y m · GEODETIC: latitude, longitude deg · PIXEL: x, y px of the shot */
    size_t shot;
    double heading_rad;
    char *path;                /* name of a road or path that it follows, or NULL: it stands */
    double start_m, offset_m;  /* along the path at time 0, also before and behind it; to its left */
    double speed_m_s;          /* along the path, negative: backward, facing that way */
    bool parked;               /* nobody is at the wheel */
    bool has_color;
    double color[3];           /* linear */
    struct source source, at_source;
};

/* Something in the photograph that hides what passes behind it. */
struct scene_occluder {
    char *name;
    struct vec2 *polygon_px;   /* (n) */
    size_t polygon_count;
    struct vec2 ground_px;     /* where it stands on the ground */
    bool in_each_shot;         /* of one camera that stays where it is */
    size_t shot;               /* else the one that it is drawn on */
    struct source source;
};

enum sky_kind { SKY_CLEAR, SKY_OVERCAST, SKY_CIE, SKY_MAP, SKY_AUTO };
enum shade_kind { SHADE_AUTO, SHADE_NONE };
enum sun_kind { SUN_NONE, SUN_BY_TIME, SUN_GIVEN, SUN_IN_MAP };
enum transfer_kind { TRANSFER_LAYERS, TRANSFER_RATIO, TRANSFER_THRESHOLD, TRANSFER_ALPHA };
enum overwrite_side { OVERWRITE_ABOVE, OVERWRITE_BELOW };
enum mask_rule { MASK_TRACED, MASK_DILATED };
enum quality { QUALITY_DRAFT, QUALITY_STANDARD, QUALITY_HIGH };

/* A measured sky: where in it true north is. */
struct scene_map {
    char *file;                /* resolved path */
    bool by_column;
    double north_px, middle_rad; /* the column of north; or the azimuth of the middle, clockwise from true north */
    struct source source, north_source;
};

/* What stands around and hides the sky, up to an elevation that goes evenly from point to point. */
struct scene_skyline {
    double (*point_rad)[2];    /* (count) azimuth, clockwise from the world's y axis, ascending from 0 to 2 pi; elevation */
    size_t count;              /* 0: nothing stands around, or something else tells what */
    bool assumed;              /* nobody told */
    double albedo[3];          /* linear */
    struct source source;
};

/* Two pixels of the same surface, in the sun and in a shadow. */
struct scene_mark { struct vec2 lit_px, shade_px; size_t shot; struct source source; };

struct scene {
    char *path;                /* of the scene file */
    uint64_t hash;             /* of the scene file's bytes */
    uint64_t rendered_hash;    /* of what it says that the passes may depend on */

    char *video;               /* resolved path, or NULL */
    struct source video_source;
    double scale;              /* photographs are reduced by this factor (1 = as they are) */
    struct scene_camera *cameras;
    size_t camera_count;
    struct scene_shot *shots;  /* (shot_count) */
    size_t shot_count;
    bool fixed_camera;         /* one camera, one pose: all shots share them */
    bool has_times;            /* shots have times of their own, or a rate */

    bool has_place;
    struct geodetic place;
    bool has_time;
    struct utc_time time_utc;  /* at time_s 0 of the shots */
    double north_rad;          /* azimuth of the world's +y axis, clockwise from true north */
    double north_shadow_m;     /* length of the marked shadow that told it, else 0 */
    double north_height_m;     /* of what casts it, by the sun's elevation */
    enum sun_kind sun;         /* BY_TIME: place and time are there; IN_MAP: the map shows whether there is one.
                                  NONE under clouds, and in a map that is taken as it is; not under a clear sky; with AUTO:
                                  where it stands is not known */
    double sun_azimuth_rad, sun_elevation_rad; /* GIVEN: azimuth clockwise from true north */
    struct source sun_source;

    struct scene_static static_;
    struct plane ground;       /* without a static mesh */
    double ground_albedo[3];   /* linear */
    struct wet wet;            /* the ground, with a plane */
    struct scene_skyline skyline; /* without a static mesh, and without a measured sky */

    enum sky_kind sky;         /* AUTO: to be told by the photographs (gen/estimate/estimate.h) */
    struct source light_source;
    double turbidity;          /* CLEAR */
    int cie_type;              /* CIE: 1 ... 15 */
    struct scene_map map;      /* MAP */
    double sun_scale;          /* multiplies the sun's irradiance; 1 */
    bool has_sky_share;        /* CLEAR: the following says how much of the light in the open is the sky's, not the model */
    double sky_share[3];
    struct scene_mark *marks;  /* AUTO */
    size_t mark_count;
    enum shade_kind shade;     /* on a plane, what of its ground the photograph shows in the shade */
    double fill;               /* shadowless light on entities, as a share of the light in the open */

    char *osm;                 /* resolved path of the road map, or NULL */
    enum driving_side driving_side;
    double sidewalk_m;
    struct scene_path *paths;
    size_t path_count;
    struct scene_movers vehicles, people;

    bool exposure_given, exposure_of_roads, exposure_of_ground; /* of none: the patch */
    double exposure[3];        /* photograph linear values per radiance unit: R, G and B */
    struct vec2 exposure_patch_px[2]; /* corners: top left, bottom right; inside the camera's picture */
    struct source exposure_source;
    bool white_balance;        /* fit each channel, not luminance only */

    struct scene_model *models;
    size_t model_count;
    struct scene_entity *entities;
    size_t entity_count;
    struct scene_occluder *occluders;
    size_t occluder_count;

    enum transfer_kind transfer;
    double t1, t2, t3;         /* 0..255 */
    enum overwrite_side overwrite;
    enum mask_rule mask;
    enum palette palette;

    bool has_mist;
    double visibility_m, haze[3]; /* haze: linear values of the photograph */
    double exposure_s;         /* the shutter is open so long; 0: nothing blurs by moving */
    double defocus_px, focus_m, softness_px, sharpening, grain, vignetting, highlights, blacks; /* as in lib/manifest.h */
    bool softness_auto, sharpening_auto, grain_auto, vignetting_auto, highlights_auto, blacks_auto, compression_auto;

    enum quality quality;
    int seed;
    char *material_rules;      /* resolved path, or NULL for the installed file */
};

/* Read and check a scene file. Everything that the file alone can tell is checked here,
 * files that it names exist.
 * In:  model_folders   where catalogues are looked for after the folder models beside the scene file; ends with
 *                      NULL. NULL: nowhere else. Read only when the scene asks for a model that is not its own
 * Err: ERR_INPUT at file:line:column with what is wrong and what would be right */
bool scene_read(struct scene **scene, const char *path, const char *const *model_folders, struct error *err);
void scene_destroy(struct scene *scene);

/* Has a picture of this size the shape of a shot's camera?
 * Err: ERR_INPUT at the camera, naming both */
bool scene_check_shape(const struct scene *scene, const struct scene_shot *shot, int width_px, int height_px, struct error *err);

/* One line a key, for the test that keeps docs/scene.md complete: "path\ttype\tunit\tdefault\n". */
char *scene_schema_text(void);

#endif
