#include "gen/model/gltf.h"

extern "C" {
#include "lib/file.h"
}

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace {

using tinygltf::Value;

/* The extensions that model_gltf.c understands, or that change nothing in what it reads. */
const char *const supported[] = { "KHR_materials_clearcoat", "KHR_materials_transmission", "KHR_materials_ior",
                                  "KHR_materials_emissive_strength", "KHR_materials_pbrSpecularGlossiness",
                                  "KHR_materials_specular", "KHR_materials_sheen", "KHR_materials_volume",
                                  "KHR_materials_variants", "KHR_texture_transform", "KHR_mesh_quantization",
                                  "KHR_lights_punctual" };

template <typename T> T *allocate(size_t n)
{
    void *memory = calloc(n ? n : 1, sizeof(T));
    if (!memory) throw std::bad_alloc();
    return static_cast<T *>(memory);
}

template <typename T> T *copy(const std::vector<T> &from)
{
    T *to = allocate<T>(from.size());
    std::copy(from.begin(), from.end(), to);
    return to;
}

char *copy(const std::string &from)
{
    char *to = allocate<char>(from.size() + 1);
    memcpy(to, from.c_str(), from.size());
    return to;
}

/* Keep an image as it came: its bytes are decoded with all other textures. */
bool keep_image(tinygltf::Image *image, const int, std::string *, std::string *, int, int, const unsigned char *bytes,
                int size, void *)
{
    if (image->bufferView < 0 && image->uri.empty()) image->image.assign(bytes, bytes + size);
    return true;
}

/* tinygltf's own way to a file expands shell words in its name; and looks in the current folder too. */
struct files {
    std::string folder;
    static bool exists(const std::string &path, void *self)
    {
        return !path.compare(0, static_cast<files *>(self)->folder.size(), static_cast<files *>(self)->folder) &&
               file_exists(path.c_str());
    }
    static std::string expand(const std::string &path, void *) { return path; }
    static bool read(std::vector<unsigned char> *out, std::string *text, const std::string &path, void *)
    {
        struct error err = {};
        char *data;
        size_t size;
        if (!file_read(&data, &size, path.c_str(), &err)) {
            *text = err.text;
            return false;
        }
        out->assign(data, data + size);
        free(data);
        return true;
    }
};

double number(const Value &object, const char *key, double otherwise)
{
    return object.Has(key) && object.Get(key).IsNumber() ? object.Get(key).GetNumberAsDouble() : otherwise;
}

int index_of(const Value &object, const char *key, int otherwise)
{
    double value = number(object, key, otherwise);
    return value >= -1 && value < 1e9 ? (int)value : -1;
}

void numbers(double *out, size_t n, const Value &object, const char *key)
{
    if (!object.Has(key) || object.Get(key).ArrayLen() != n) return;
    for (size_t i = 0; i < n; i++) out[i] = object.Get(key).Get((int)i).GetNumberAsDouble();
}

void transform(gltf_texture_use *use, const Value &object)
{
    numbers(use->offset, 2, object, "offset");
    numbers(use->scale, 2, object, "scale");
    use->rotation_rad = number(object, "rotation", 0);
    use->uv_set = index_of(object, "texCoord", use->uv_set);
}

gltf_texture_use texture_use(const tinygltf::TextureInfo &info)
{
    gltf_texture_use use = { info.index, info.texCoord, { 0, 0 }, 0, { 1, 1 } };
    auto found = info.extensions.find("KHR_texture_transform");
    if (found != info.extensions.end()) transform(&use, found->second);
    return use;
}

/* The same from an extension's own JSON. */
gltf_texture_use texture_use(const Value &parent, const char *key)
{
    gltf_texture_use use = { -1, 0, { 0, 0 }, 0, { 1, 1 } };
    if (!parent.Has(key)) return use;
    const Value &info = parent.Get(key);
    use.texture = index_of(info, "index", -1);
    use.uv_set = index_of(info, "texCoord", 0);
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
        transform(&use, info.Get("extensions").Get("KHR_texture_transform"));
    return use;
}

void fill(gltf_material *to, const tinygltf::Material &from)
{
    const auto &pbr = from.pbrMetallicRoughness;
    static const Value none;
    auto extension = [&](const char *name) -> const Value & {
        auto found = from.extensions.find(name);
        return found == from.extensions.end() ? none : found->second;
    };
    to->name = copy(from.name);
    to->alpha_mode = copy(from.alphaMode);
    to->alpha_cutoff = from.alphaCutoff;
    for (size_t i = 0; i < 4; i++) to->base_color[i] = pbr.baseColorFactor.size() == 4 ? pbr.baseColorFactor[i] : 1;
    to->metallic = pbr.metallicFactor;
    to->roughness = pbr.roughnessFactor;
    to->base = texture_use(pbr.baseColorTexture);
    to->metallic_roughness = texture_use(pbr.metallicRoughnessTexture);
    to->emissive_texture = texture_use(from.emissiveTexture);
    double strength = number(extension("KHR_materials_emissive_strength"), "emissiveStrength", 1);
    for (size_t i = 0; i < 3; i++) to->emissive[i] = strength * (from.emissiveFactor.size() == 3 ? from.emissiveFactor[i] : 0);
    to->clearcoat = number(extension("KHR_materials_clearcoat"), "clearcoatFactor", 0);
    to->clearcoat_roughness = number(extension("KHR_materials_clearcoat"), "clearcoatRoughnessFactor", 0);
    to->transmission = number(extension("KHR_materials_transmission"), "transmissionFactor", 0);
    to->ior = number(extension("KHR_materials_ior"), "ior", 1.5);
    const Value &glossy = extension("KHR_materials_pbrSpecularGlossiness");
    to->has_figures = !from.values.empty() || glossy.IsObject();
    if (glossy.IsObject()) {
        /* The older model: what it calls diffuse is the base colour of a material that is no metal. */
        numbers(to->base_color, 4, glossy, "diffuseFactor");
        to->base = texture_use(glossy, "diffuseTexture");
        to->metallic = 0;
        to->roughness = 1 - number(glossy, "glossinessFactor", 1);
        to->metallic_roughness.texture = -1;
    }
}

gltf_primitive primitive(const tinygltf::Primitive &from)
{
    auto attribute = [&](const std::string &name) {
        auto found = from.attributes.find(name);
        return found == from.attributes.end() ? -1 : found->second;
    };
    gltf_primitive to = {};
    to.mode = from.mode;
    to.material = from.material;
    to.indices = from.indices;
    to.position = attribute("POSITION");
    to.normal = attribute("NORMAL");
    to.has_targets = !from.targets.empty();
    for (int i = 0; i < GLTF_UV_SETS; i++) to.uv[i] = attribute("TEXCOORD_" + std::to_string(i));
    for (int i = 0; i < GLTF_JOINT_SETS; i++) {
        to.joints[i] = attribute("JOINTS_" + std::to_string(i));
        to.weights[i] = attribute("WEIGHTS_" + std::to_string(i));
    }
    return to;
}

bool any(const std::vector<double> &weights)
{
    return std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; });
}

/* Hand an array over: it is visible to gltf_release before anything in it can throw. */
template <typename To, typename From, typename F>
void each(To **to, size_t *count, const std::vector<From> &from, F f)
{
    *to = allocate<To>(from.size());
    *count = from.size();
    for (size_t i = 0; i < from.size(); i++) f((*to)[i], from[i]);
}

void fill(gltf *out, const tinygltf::Model &model)
{
    each(&out->buffers, &out->buffer_count, model.buffers, [](gltf_buffer &to, const tinygltf::Buffer &from) {
        to.data = copy(from.data);
        to.size = from.data.size();
    });
    each(&out->views, &out->view_count, model.bufferViews, [](gltf_view &to, const tinygltf::BufferView &from) {
        to = { from.buffer, from.byteOffset, from.byteLength, from.byteStride };
    });
    each(&out->accessors, &out->accessor_count, model.accessors, [](gltf_accessor &to, const tinygltf::Accessor &from) {
        to = {};
        to.view = from.bufferView;
        to.component = from.componentType;
        to.components = tinygltf::GetNumComponentsInType((uint32_t)from.type);
        to.offset = from.byteOffset;
        to.count = from.count;
        to.normalized = from.normalized;
        to.sparse = from.sparse.isSparse;
        if (!to.sparse) return;
        to.sparse_count = (size_t)std::max(from.sparse.count, 0);
        to.sparse_index_view = from.sparse.indices.bufferView;
        to.sparse_index_component = from.sparse.indices.componentType;
        to.sparse_index_offset = (size_t)std::max(from.sparse.indices.byteOffset, 0);
        to.sparse_value_view = from.sparse.values.bufferView;
        to.sparse_value_offset = (size_t)std::max(from.sparse.values.byteOffset, 0);
    });
    each(&out->meshes, &out->mesh_count, model.meshes, [](gltf_mesh &to, const tinygltf::Mesh &from) {
        to.is_morphed = any(from.weights);
        each(&to.primitives, &to.primitive_count, from.primitives,
             [](gltf_primitive &p, const tinygltf::Primitive &q) { p = primitive(q); });
    });
    each(&out->nodes, &out->node_count, model.nodes, [](gltf_node &to, const tinygltf::Node &from) {
        to = { from.mesh, from.skin, copy(from.children), from.children.size(), from.matrix.size() == 16,
               any(from.weights), {}, { 0, 0, 0 }, { 0, 0, 0, 1 }, { 1, 1, 1 }, from.name == "driver" };
        std::copy_n(from.matrix.begin(), to.has_matrix ? 16 : 0, to.matrix);
        std::copy_n(from.translation.begin(), from.translation.size() == 3 ? 3 : 0, to.translation);
        std::copy_n(from.rotation.begin(), from.rotation.size() == 4 ? 4 : 0, to.rotation);
        std::copy_n(from.scale.begin(), from.scale.size() == 3 ? 3 : 0, to.scale);
    });
    each(&out->skins, &out->skin_count, model.skins, [](gltf_skin &to, const tinygltf::Skin &from) {
        to = { from.inverseBindMatrices, copy(from.joints), from.joints.size() };
    });
    each(&out->images, &out->image_count, model.images, [](gltf_image &to, const tinygltf::Image &from) {
        to.view = from.bufferView;
        if (!from.uri.empty()) to.uri = copy(from.uri);
        else if (from.bufferView < 0) to.data = copy(from.image);
        to.size = from.image.size();
    });
    each(&out->textures, &out->texture_count, model.textures, [&](gltf_texture &to, const tinygltf::Texture &from) {
        bool sampled = from.sampler >= 0 && (size_t)from.sampler < model.samplers.size();
        to = { from.source, sampled ? model.samplers[(size_t)from.sampler].wrapS : GLTF_REPEAT,
               sampled ? model.samplers[(size_t)from.sampler].wrapT : GLTF_REPEAT };
    });
    each(&out->materials, &out->material_count, model.materials,
         [](gltf_material &to, const tinygltf::Material &from) { fill(&to, from); });
    std::vector<gltf_channel> channels;
    each(&out->animations, &out->animation_count, model.animations, [&](gltf_animation &made, const tinygltf::Animation &animation) {
        made.name = copy(animation.name);
        made.first = channels.size();
        for (const auto &from : animation.channels) {
            gltf_channel to = { from.target_node, -1, -1, GLTF_TRANSLATION, GLTF_LINEAR };
            if (from.sampler >= 0 && (size_t)from.sampler < animation.samplers.size()) {
                const auto &sampler = animation.samplers[(size_t)from.sampler];
                to.input = sampler.input;
                to.output = sampler.output;
                to.interpolation = sampler.interpolation == "CUBICSPLINE" ? GLTF_CUBIC : sampler.interpolation == "STEP" ? GLTF_STEP : GLTF_LINEAR;
            }
            if (from.target_path == "rotation") to.path = GLTF_ROTATION;
            else if (from.target_path == "scale") to.path = GLTF_SCALE;
            else if (from.target_path != "translation") continue;
            channels.push_back(to);
        }
        made.count = channels.size() - made.first;
    });
    out->channels = copy(channels);
    out->channel_count = channels.size();
    std::vector<int> roots;
    if (!model.scenes.empty()) {
        size_t scene = model.defaultScene >= 0 && (size_t)model.defaultScene < model.scenes.size() ? (size_t)model.defaultScene : 0;
        roots = model.scenes[scene].nodes;
    } else {
        std::vector<bool> is_child(model.nodes.size());
        for (const auto &node : model.nodes)
            for (int child : node.children)
                if (child >= 0 && (size_t)child < is_child.size()) is_child[(size_t)child] = true;
        for (size_t i = 0; i < is_child.size(); i++)
            if (!is_child[i]) roots.push_back((int)i);
    }
    out->roots = copy(roots);
    out->root_count = roots.size();
}

uint32_t u32_at(const char *bytes)
{
    const unsigned char *b = reinterpret_cast<const unsigned char *>(bytes);
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

bool read(gltf *out, const char *data, size_t size, const char *path, struct error *err)
{
    bool binary = size >= 4 && !memcmp(data, "glTF", 4);
    if (size > UINT32_MAX) return error_at(err, ERR_INPUT, path, 0, 0, "is larger than a glTF file can be (4 GB)");
    if (binary && (size < 20 || u32_at(data + 8) > size))
        return error_at(err, ERR_INPUT, path, 0, 0, "is truncated: it has %zu bytes, its header tells of %u", size,
                        size < 12 ? 20u : u32_at(data + 8));
    files folder;
    char *name = path_folder(path);
    if (!name) throw std::bad_alloc();
    folder.folder = std::string(name) + "/";
    free(name);

    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string text, warning;
    tinygltf::FsCallbacks callbacks = { files::exists, files::expand, files::read, nullptr, &folder };
    reader.SetFsCallbacks(callbacks);
    reader.SetImageLoader(keep_image, nullptr);
    bool ok = binary ? reader.LoadBinaryFromMemory(&model, &text, &warning, reinterpret_cast<const unsigned char *>(data),
                                                   (unsigned)size, folder.folder)
                     : reader.LoadASCIIFromString(&model, &text, &warning, data, (unsigned)size, folder.folder);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    if (!ok) return error_at(err, ERR_INPUT, path, 0, 0, "is no glTF file that can be read: %s", text.c_str());
    if (model.asset.version.compare(0, 2, "2."))
        return error_at(err, ERR_INPUT, path, 0, 0, "is glTF version %s: version 2.0 would be right", model.asset.version.c_str());
    for (const std::string &required : model.extensionsRequired)
        if (std::none_of(std::begin(supported), std::end(supported), [&](const char *s) { return required == s; }))
            return error_at(err, ERR_INPUT, path, 0, 0, "requires the glTF extension %s, which is not supported: export it without", required.c_str());
    fill(out, model);
    return true;
}

} // namespace

bool gltf_read(struct gltf *gltf, const char *path, struct error *err)
{
    char *data;
    size_t size;
    struct gltf made = {};
    if (!file_read(&data, &size, path, err)) return false;
    bool ok;
    try {
        ok = read(&made, data, size, path, err);
    } catch (const std::bad_alloc &) {
        ok = error_at(err, ERR_MEMORY, path, 0, 0, "no memory for this model");
    } catch (const std::exception &e) {
        ok = error_at(err, ERR_INPUT, path, 0, 0, "is no glTF file that can be read: %s", e.what());
    }
    free(data);
    if (ok) *gltf = made;
    else gltf_release(&made);
    return ok;
}

void gltf_release(struct gltf *gltf)
{
    for (size_t i = 0; i < gltf->buffer_count; i++) free(gltf->buffers[i].data);
    for (size_t i = 0; i < gltf->mesh_count; i++) free(gltf->meshes[i].primitives);
    for (size_t i = 0; i < gltf->node_count; i++) free(gltf->nodes[i].children);
    for (size_t i = 0; i < gltf->skin_count; i++) free(gltf->skins[i].joints);
    for (size_t i = 0; i < gltf->image_count; i++) {
        free(gltf->images[i].uri);
        free(gltf->images[i].data);
    }
    for (size_t i = 0; i < gltf->material_count; i++) {
        free(gltf->materials[i].name);
        free(gltf->materials[i].alpha_mode);
    }
    for (size_t i = 0; i < gltf->animation_count; i++) free(gltf->animations[i].name);
    free(gltf->animations);
    free(gltf->buffers);
    free(gltf->views);
    free(gltf->accessors);
    free(gltf->meshes);
    free(gltf->nodes);
    free(gltf->skins);
    free(gltf->channels);
    free(gltf->images);
    free(gltf->textures);
    free(gltf->materials);
    free(gltf->roots);
    *gltf = {};
}
