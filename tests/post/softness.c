#include "post/softness.h"

#include "tests/post/layers.h"
#include "tests/tap.h"

#define W 41
#define H 21

int main(void)
{
    struct image object = filled(W, H, 4, 0), light = filled(W, H, 3, 0);
    struct error err = ERROR_NONE;
    image_f32(&object, 20, 10)[3] = 1;
    image_f32(&light, 20, 10)[0] = -0.5f;
    if (!OK(softness_blur(&object, &light, NULL, NULL, 1, &err), "layers are softened")) return tap_done();
    NEAR(sum_of(&object, 3), 1, 1e-6, "and are no more and no less");
    /* sum k^2 exp(-k^2/2) / sum exp(-k^2/2) for k from -3 to 3 */
    NEAR(variance_of(&object, 3, 20), 0.995909, 1e-4, "by a Gaussian of this standard deviation, to 3 of them");
    NEAR(variance_of(&light, 0, 20), 0.995909, 1e-4, "entities and light on the ground alike");
    NEAR((double)image_f32(&object, 21, 10)[3] / (double)image_f32(&object, 20, 10)[3], exp(-0.5), 1e-5, "which falls as it must");
    OK(image_f32(&object, 24, 10)[3] == 0 && image_f32(&light, 20, 14)[0] == 0, "beyond, nothing changes");
    OK(image_f32(&light, 20, 10)[1] == 0, "nor in other channels");

    memset(object.data, 0, image_size(&object));
    image_f32(&object, 20, 10)[3] = 1;
    OK(softness_blur(&object, &light, NULL, NULL, 0.4, &err), "by less than a pixel");
    NEAR(variance_of(&object, 3, 20), 0.16, 1e-3, "they are softened as much as asked");

    memset(object.data, 0, image_size(&object));
    memset(light.data, 0, image_size(&light));
    fill(&object, 10, 0, 30, H, (float[]){ 0.2f, 0.2f, 0.2f, 1 });
    fill(&light, 10, 0, 30, H, (float[]){ -0.5f, 0, 0, 0 });
    for (int y = 0; y < H; y++) {
        image_f32(&object, 9, y)[3] = image_f32(&object, 30, y)[3] = 0.5f;
        for (int c = 0; c < 3; c++) image_f32(&object, 9, y)[c] = image_f32(&object, 30, y)[c] = 0.1f;
    }
    OK(softness_take_back(&object, &light, 0.08, &err), "what is too soft is made narrower");
    NEAR((double)image_f32(&object, 9, 10)[3], 0.5, 1e-6, "its outline stays where it is");
    OK(image_f32(&object, 10, 10)[3] == 1 && image_f32(&object, 8, 10)[3] == 0, "its cover within bounds");
    NEAR((double)image_f32(&object, 10, 10)[0], 0.2, 1e-6, "its colour what it was");
    NEAR((double)image_f32(&light, 10, 10)[0], -0.52, 1e-6, "a step of the light gets 0.04 of it steeper");
    NEAR((double)image_f32(&light, 9, 10)[0], 0.02, 1e-6, "on both sides");
    OK(image_f32(&light, 7, 10)[0] == 0, "and nothing else changes");

    memset(light.data, 0, image_size(&light));
    memset(object.data, 0, image_size(&object));
    fill(&object, 10, 0, 30, H, (float[]){ 0.2f, 0.2f, 0.2f, 1 });
    struct image hidden = hidden_between(W, H, 20, 30);
    OK(softness_blur(&object, &light, &hidden, &hidden, 1.5, &err), "of what is half hidden");
    NEAR((double)image_f32(&object, 19, 10)[0], 0.2, 1e-5, "what can be seen is not darkened");
    OK(image_f32(&object, 31, 10)[3] == 0, "and what cannot does not come out");
    OK(*image_u8(&hidden, 19, 10) == 255 && *image_u8(&hidden, 20, 10) == 0, "the edge of what hides is as it was");
    OK(softness_share(&hidden, 1, &err), "until it is softened too");
    /* The normal distribution: 0.5 px beyond the edge, 1.5, 2.5. */
    static const double beyond[] = { 0.6915, 0.9332, 0.9938 };
    for (int i = 0; i < 3; i++) {
        NEAR(*image_u8(&hidden, 19 - i, 10) / 255.0, beyond[i], 0.012, "what is seen %g px before it", i + 0.5);
        NEAR(*image_u8(&hidden, 20 + i, 10) / 255.0, 1 - beyond[i], 0.012, "and %g px within", i + 0.5);
    }
    OK(*image_u8(&hidden, 10, 10) == 255 && *image_u8(&hidden, 25, 10) == 0, "farther off it is as it was");
    image_release(&hidden);
    image_release(&object);
    image_release(&light);
    return tap_done();
}
