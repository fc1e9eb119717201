#include "tests/gen/model_files.h"

static void ply_is_read(void)
{
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                              "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 0\n2 0 0\n0 1 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    struct model *m = load(put_text("t.ply", ply), &metres_z_up);
    OK(m && triangles(m) == 4 && fabs(volume(m) - 1) < 1e-5 && m->materials[0].names_only, "a PLY file is read");
    model_destroy(m);
    char lying[sizeof ply + 16];
    const char *at = strstr(ply, "vertex 4");
    snprintf(lying, sizeof lying, "%.*svertex 4000000000%s", (int)(at - ply), ply, at + 8);
    refused(put_text("lying.ply", lying), &metres_z_up, "lying.ply: the PLY header tells of 4000000000 elements \"vertex\", but only 56 bytes follow", "refuses a PLY header that tells of more than there is");
    m = load(put_text("none.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                  "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n0\n"), &metres_z_up);
    OK(m && triangles(m) == 1, "a face without corners is passed over");
    model_destroy(m);
    static const char binary[] = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                                 "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    char cut[sizeof binary + 64] = { 0 };
    memcpy(cut, binary, sizeof binary - 1);
    refused(put("vertex.ply", cut, sizeof binary - 1 + 20), &metres_z_up, "vertex.ply: the PLY header tells of 2 elements \"vertex\", but only 20 bytes follow", "refuses a binary PLY file that ends among its vertices");
    cut[sizeof binary - 1 + 24] = 3;
    cut[sizeof binary - 1 + 25] = 7;
    refused(put("face.ply", cut, sizeof binary - 1 + 24 + 26), &metres_z_up, "face.ply: a face uses vertex 7 of 2", "refuses a face of a vertex that is not there");
    cut[sizeof binary - 1 + 24] = 100;
    cut[sizeof binary - 1 + 25] = 0;
    refused(put("list.ply", cut, sizeof binary - 1 + 24 + 13), &metres_z_up, "list.ply: is truncated, or has no number where one belongs: element \"face\" 1 of 2", "refuses a binary PLY file that ends in a list");
    refused(put_text("xyz.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"), &metres_z_up, "xyz.ply: the PLY header gives vertices no x, y and z", "refuses vertices without coordinates");
    refused(put_text("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n0\n"), &metres_z_up, "type.ply: the PLY header has a property of unknown type \"half\"", "refuses a type that there is not");
    m = load(put_text("rich.ply", "ply\nformat ascii 1.0\ncomment TextureFile none.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                                  "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 1\nproperty uchar flags\nproperty list uchar uint vertex_index\nend_header\n"
                                  "0 0 0 0 0 1 0 0 255 0 188 255\n1 0 0 0 0 1 1 0 255 0 188 255\n1 1 0 0 0 1 1 1 255 0 188 255\n0 1 0 0 0 1 0 0.75 255 0 188 255\n1 4 0 1 2 3\n"), &metres_z_up);
    OK(m && triangles(m) == 2 && vertices(m) == 4 && m->meshes[0].triangle[1][0] == 0 && m->meshes[0].triangle[1][1] == 2 && m->meshes[0].triangle[1][2] == 3, "a polygon becomes a fan");
    OK(m && m->meshes[0].uv && m->meshes[0].uv[3][1] == 0.75f && m->missing_texture_count == 1 && !strcmp(m->missing_textures[0], "none.png"), "uv and the texture's name are read");
    OK(m && m->materials[0].base_color[0] == 1 && m->materials[0].base_color[1] == 0 && fabs(m->materials[0].base_color[2] - 0.5028865) < 1e-5, "vertex colours become their mean, in linear light");
    model_destroy(m);
    unsigned char big[512];
    int header = snprintf((char *)big, sizeof big, "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty short y\nproperty short z\nelement face 1\nproperty list uchar ushort vertex_indices\nend_header\n");
    static const unsigned char body[] = { 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xfe, 0, 0, 3, 0, 0, 0, 1, 0, 2 };
    memcpy(big + header, body, sizeof body);
    m = load(put("big.ply", big, (size_t)header + sizeof body), &metres_z_up);
    OK(m && triangles(m) == 1 && has_vertex(m, 128, 1, 0) && has_vertex(m, -128, -1, 0), "a big-endian file is read");
    model_destroy(m);
    refused(put_text("none.ply", "plx\n"), &metres_z_up, "none.ply: is no PLY file: it has no header", "refuses a PLY file without a header");
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    ply_is_read();
    remove_tree(folder);
    return tap_done();
}
