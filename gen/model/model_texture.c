#include "gen/model/model_texture.h"

#include "lib/file.h"
#include "lib/image.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* --- finding --- */

/* A name written for any machine, as a path of this one: no scheme, no drive, slashes. */
static char *portable(const char *name)
{
    const char *scheme = strstr(name, "://");
    if (scheme) name = scheme + 3;
    else if (name[0] && name[1] == ':') name += 2;
    char *path = strdup(name);
    for (char *c = path; c && *c; c++)
        if (*c == '\\') *c = '/';
    return path;
}

static bool is_folder(const char *path)
{
    struct stat st;
    return lstat(path, &st) == 0 && S_ISDIR(st.st_mode);
}

static int visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

/* Folders that people put textures into. */
static bool tells_of_textures(const char *folder)
{
    static const char *const words[] = { "tex", "material", "image", "img", "map" };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcasestr(folder, words[i])) return true;
    return false;
}

/* `name` in `folder`: in the same letters, else in any; then in the folders below (of `depth`
 * levels), or those of them that tell of textures. */
static char *find_in(const char *folder, const char *name, int depth, bool texture_folders_only)
{
    struct dirent **entries;
    int n = scandir(folder, &entries, visible, alphasort);
    if (n < 0) return NULL;
    char *found = NULL;
    for (int pass = 0; pass < 2 && !found; pass++)
        for (int i = 0; i < n && !found; i++) {
            if (pass ? strcasecmp(entries[i]->d_name, name) : strcmp(entries[i]->d_name, name)) continue;
            found = string_format("%s/%s", folder, entries[i]->d_name);
            if (found && !file_exists(found)) {
                free(found);
                found = NULL;
            }
        }
    for (int i = 0; i < n && !found && depth > 0; i++) {
        if (texture_folders_only && !tells_of_textures(entries[i]->d_name)) continue;
        char *below = string_format("%s/%s", folder, entries[i]->d_name);
        if (below && is_folder(below)) found = find_in(below, name, depth - 1, false);
        free(below);
    }
    for (int i = 0; i < n; i++) free(entries[i]);
    free(entries);
    return found;
}

char *texture_find(const char *model_path, const char *name)
{
    char *path = portable(name), *folder = path_folder(model_path);
    char *written = path ? path_beside(model_path, path) : NULL, *above = folder ? string_format("%s/..", folder) : NULL;
    char *found = NULL;
    if (written && above && *path_name(path)) {
        if (file_exists(written)) found = strdup(written);
        if (!found) found = find_in(folder, path_name(path), 2, false);
        if (!found) found = find_in(above, path_name(path), 2, true);
    }
    free(path);
    free(folder);
    free(written);
    free(above);
    return found;
}

/* --- reading --- */

bool texture_make_u8(struct image *image, struct error *err)
{
    if (image->type == PIXEL_U8 && image->channels >= 3) return true;
    struct image out;
    int channels = image->channels == 4 ? 4 : 3;
    if (!image_init(&out, image->width_px, image->height_px, channels, PIXEL_U8, err)) return false;
    for (int y = 0; y < out.height_px; y++)
        for (int x = 0; x < out.width_px; x++)
            for (int c = 0; c < channels; c++) {
                int from = image->channels >= 3 ? c : 0;
                float f = 0;
                if (image->type == PIXEL_U8) f = (float)image_u8(image, x, y)[from] / 255;
                else if (image->type == PIXEL_U16) f = (float)image_u16(image, x, y)[from] / 65535;
                else f = c == 3 ? image_f32(image, x, y)[from] : srgb_from_linear(image_f32(image, x, y)[from]);
                image_u8(&out, x, y)[c] = (uint8_t)((f > 0 ? f < 1 ? f : 1 : 0) * 255 + 0.5f);
            }
    image_release(image);
    *image = out;
    return true;
}

/* Each text once. */
static bool append(char ***list, size_t *count, const char *text, struct error *err)
{
    for (size_t i = 0; i < *count; i++)
        if (!strcmp((*list)[i], text)) return true;
    char **grown = realloc(*list, (*count + 1) * sizeof *grown);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for a model");
    *list = grown;
    if (!(grown[*count] = strdup(text))) return error_set(err, ERR_MEMORY, "no memory for a model");
    ++*count;
    return true;
}

/* Out: *out, empty when the texture is not found (which is then named in the model). */
static bool read_image(struct image *out, struct model *model, const struct import_image *image, struct error *err)
{
    *out = (struct image){ 0 };
    bool ok;
    if (image->data) {
        ok = image_decode(out, image->data, image->size, model->path, err) || error_prefix(err, "%s: ", image->name);
    } else {
        char *path = texture_find(model->path, image->name);
        if (!path) return append(&model->missing_textures, &model->missing_texture_count, image->name, err);
        ok = image_read(out, path, err) && append(&model->textures, &model->texture_count, path, err);
        free(path);
    }
    if (ok && !texture_make_u8(out, err)) {
        image_release(out);
        ok = false;
    }
    return ok;
}

/* --- attaching --- */

/* Mean of a channel; `linear` takes the sRGB curve away. */
static double mean(const struct image *image, int channel, bool linear)
{
    double sum = 0;
    size_t n = (size_t)image->width_px * (size_t)image->height_px, histogram[256] = { 0 };
    const uint8_t *p = (const uint8_t *)image->data + channel;
    for (size_t i = 0; i < n; i++) histogram[p[i * (size_t)image->channels]]++;
    for (int i = 0; i < 256; i++) {
        float f = (float)i / 255;
        sum += (double)histogram[i] * (double)(linear ? linear_from_srgb(f) : f);
    }
    return sum / (double)n;
}

static bool has_holes(const struct image *image)
{
    if (image->channels < 4) return false;
    size_t n = (size_t)image->width_px * (size_t)image->height_px;
    const uint8_t *p = image->data;
    for (size_t i = 0; i < n; i++)
        if (p[4 * i + 3] < 255) return true;
    return false;
}

/* The base texture with an opacity texture as its alpha: the alpha of that one if it has one, else its brightness. */
static bool with_opacity(struct image *out, const struct image *base, const struct image *opacity, struct error *err)
{
    struct image scaled = { 0 };
    bool same_size = base->width_px == opacity->width_px && base->height_px == opacity->height_px;
    if (!same_size && !image_resize(&scaled, opacity, base->width_px, base->height_px, err)) return false;
    const struct image *alpha = same_size ? opacity : &scaled;
    bool ok = image_init(out, base->width_px, base->height_px, 4, PIXEL_U8, err);
    for (int y = 0; ok && y < out->height_px; y++)
        for (int x = 0; x < out->width_px; x++) {
            const uint8_t *a = image_u8(alpha, x, y);
            uint8_t *to = image_u8(out, x, y);
            memcpy(to, image_u8(base, x, y), 3);
            to[3] = alpha->channels == 4 && has_holes(opacity) ? a[3] : (uint8_t)((54 * a[0] + 183 * a[1] + 19 * a[2]) >> 8);
        }
    image_release(&scaled);
    return ok;
}

static bool append_image(struct model *model, struct image *image, struct error *err)
{
    struct image *grown = realloc(model->images, (model->image_count + 1) * sizeof *grown);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for a model");
    model->images = grown;
    model->images[model->image_count++] = *image;
    *image = (struct image){ 0 };
    return true;
}

static void attach_means(struct material *material, const struct import_material *from, const struct image *read)
{
    if (from->metallic_roughness != NO_IMAGE && read[from->metallic_roughness].data) {
        material->roughness *= mean(&read[from->metallic_roughness], 1, false);
        material->metallic *= mean(&read[from->metallic_roughness], 2, false);
    }
    if (from->emissive != NO_IMAGE && read[from->emissive].data)
        for (int c = 0; c < 3; c++) material->emissive[c] *= mean(&read[from->emissive], c, true);
}

bool model_attach_textures(struct model *model, const struct import *import, struct error *err)
{
    size_t n = import->image_count;
    struct image *read = calloc(n + 1, sizeof *read);
    bool *wanted = calloc(n + 1, sizeof *wanted), *kept = calloc(n + 1, sizeof *kept);
    if (!read || !wanted || !kept) {
        error_set(err, ERR_MEMORY, "no memory for a model");
        goto out;
    }
    for (size_t i = 0; i < import->material_count; i++) {
        const struct import_material *m = &import->materials[i];
        int uses[] = { m->base, m->opacity, m->metallic_roughness, m->emissive };
        for (size_t k = 0; k < sizeof uses / sizeof *uses; k++)
            if (uses[k] != NO_IMAGE) wanted[uses[k]] = true;
    }
    for (size_t i = 0; i < n; i++)
        if (wanted[i] && !read_image(&read[i], model, &import->images[i], err)) goto out;
    for (size_t i = 0; i < import->material_count; i++) {
        const struct import_material *from = &import->materials[i];
        struct material *to = &model->materials[i];
        const struct image *base = from->base != NO_IMAGE && read[from->base].data ? &read[from->base] : NULL;
        const struct image *opacity = from->opacity != NO_IMAGE && read[from->opacity].data ? &read[from->opacity] : NULL;
        attach_means(to, from, read);
        if (base) {
            to->base_image = *base;
            kept[from->base] = true;
            if (from->base_replaces_color) to->base_color[0] = to->base_color[1] = to->base_color[2] = 1;
            if (opacity && from->opacity != from->base) {
                struct image merged;
                if (!with_opacity(&merged, base, opacity, err)) goto out;
                to->base_image = merged;
                if (!append_image(model, &merged, err)) {
                    image_release(&merged);
                    goto out;
                }
            }
        }
        bool solid = to->alpha >= 1 && !has_holes(&to->base_image);
        if (solid) to->alpha_mode = ALPHA_OPAQUE;
    }
    for (size_t i = 0; i < n; i++)
        if (kept[i] && !append_image(model, &read[i], err)) goto out;
out:
    for (size_t i = 0; read && i < n; i++) image_release(&read[i]);
    free(read);
    free(wanted);
    free(kept);
    return err->code == ERR_OK;
}
