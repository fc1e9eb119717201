#include "post/optics.h"

#include "post/defocus.h"
#include "post/ground_light.h"
#include "post/mist.h"
#include "post/motion.h"
#include "post/softness.h"

bool optics_wanted(const struct manifest *m)
{
    return m->has_mist || m->has_motion || m->defocus_px > 0 || m->softness_px > 0;
}

/* Mist comes last: how much of a pixel's light is the ground's own is the photograph's affair, which is blurred already. */
static bool fade(struct image *object, struct image *plane, struct image *light, const struct optics_input *in, struct error *err)
{
    const struct manifest *m = in->manifest;
    struct mist mist = { .visibility_m = m->visibility_m };
    for (int c = 0; c < 3; c++) {
        mist.haze[c] = m->haze[c];
        mist.exposure[c] = in->exposure[c];
    }
    return mist_fade(object, plane, light, &mist, in->photograph, in->depth, in->ground, &m->camera, m->view.window_px, err);
}

bool optics_apply(struct image *object, struct image *plane, struct image *shadow, const struct optics_input *in,
                  struct error *err)
{
    const struct manifest *m = in->manifest;
    const struct image *v = in->visible, *g = in->receiver;
    struct image light;
    if (!optics_wanted(m) && in->too_soft_px2 <= 0) return true;
    if (!ground_light_take(&light, plane, shadow, err)) return false;
    bool ok = (in->too_soft_px2 <= 0 || softness_take_back(object, &light, in->too_soft_px2, err)) &&
              (!m->has_motion || motion_blur(object, &light, in->motion, in->depth, plane, v, g, err)) &&
              (m->defocus_px <= 0 || defocus_blur(object, &light, in->depth, in->ground, v, g, m->defocus_px, m->focus_m, err)) &&
              (m->softness_px <= 0 || softness_blur(object, &light, v, g, m->softness_px, err)) &&
              (!m->has_mist || fade(object, plane, &light, in, err));
    if (ok) ground_light_put(plane, shadow, &light, in->photograph, in->exposure);
    image_release(&light);
    return ok;
}
