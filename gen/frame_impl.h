/* A frame while it is made: for its own files. */
#ifndef STAFFAGE_GEN_FRAME_IMPL_H
#define STAFFAGE_GEN_FRAME_IMPL_H

#include "gen/frame.h"
#include "gen/light/exposure.h"
#include "gen/moment.h"
#include "gen/world/receiver.h"
#include "gen/world/surroundings.h"

struct frame {
    const struct frame_context *context;
    const struct scene *scene;      /* the context's */
    const struct stage *stage;
    const struct scene_shot *shot;
    const struct camera *camera;
    const char *name, *folder, *photograph;
    const struct frame_keys *keys;
    struct moment moment;
    struct receiver *receivers;     /* (moment.n) */
    struct surroundings around;     /* with a static mesh */
    struct occluder *occluders;     /* (occluder_count) this shot's, polygons at the size of the result; owned */
    size_t occluder_count;
    struct frame_labels labels;
    bool *matters;                  /* (moment.n) seen, or shading what is seen */
    struct image motion;            /* empty: nothing blurs by moving */
    struct image picture;           /* U8, 3 channels: the photograph, or a new view's background; empty until it is read */
    double shaded;                  /* share of the ground in view that lies in the shade of what stands in the picture */
    struct exposure exposure;       /* of the picture; of an empty frame none */
};

/* A pixel position of the scene file, at the size of the result. */
struct vec2 frame_scaled_px(const struct frame *f, struct vec2 q);
/* What ground a pixel position of the result shows. */
bool frame_ground_at(struct vec3 *p_m, const struct frame *f, struct vec2 q_px);

/* The picture as post merges into it: frame_exposure.c */
bool frame_read_picture(struct frame *f, struct error *err);
/* The exposure, given or fitted to the picture, at the scene's line when it cannot be. */
bool frame_expose(struct frame *f, struct error *err);

/* The manifest, the last file of a frame: frame_manifest.c */
bool frame_write_manifest(const struct frame *f, const struct frame_result *result, struct error *err);
/* What is round the entities that matter, into the frame's folder: frame_surroundings.c
 * In: sight  the sky past them; a rough mesh stands in the way of its own ground, and is not in it
 * Out: *surroundings, untouched on failure; free with frame_release_surroundings */
bool frame_write_surroundings(struct pass_surroundings *surroundings, struct frame *f, const struct sky_sight *sight, struct error *err);
/* The ground right below an entity: frame.c */
struct plane frame_local_ground(const struct frame *f, const struct entity *entity);
void frame_release_surroundings(struct pass_surroundings *surroundings);
/* What POV-Ray renders, in a view: frame_passes.c */
bool frame_write_passes(struct frame *f, const struct view *view, struct error *err);

#endif
