#include "gen/render/makefile.h"

#include "lib/file.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const pass_names[PASS_COUNT] = { "object", "plane", "shadow" };

const char *pass_name(int pass)
{
    return pass_names[pass];
}

/* After the frames' own values: FRAMES, and of each that is not empty object_N, plane_N and shadow_N. */
static const char rules[] =
    "STAFFAGE_POVRAY ?= staffage-povray\n"
    "STAFFAGE_POST ?= staffage-post\n"
    "MAKEFLAGS += --no-builtin-rules\n"
    ".SUFFIXES:\n"
    ".PHONY: all render post\n"
    "all: post\n"
    "\n"
    "TEMPLATES := $(wildcard templates/*.inc)\n"
    "OUTPUTS := rgb/%.png semantic/%.png semantic_id/%.png instance/%.png depth/%.png depth/%.exr \\\n"
    "  amodal/%.json labels/%.json\n"
    "passes = $(if $(object_$(1)),object plane shadow)\n"
    "\n"
    "# pass FRAME PASS\n"
    "define pass\n"
    "frames/$(1)/$(2).exr: frames/$(1)/$(2).pov frames/$(1)/passes.key $(TEMPLATES) | frames/$(1)/frame.json\n"
    "\t@$$(STAFFAGE_POVRAY) frames/$(1)/$(2) $($(2)_$(1))\n"
    "\t@echo staffage: pass $(1) $(2)\n"
    "endef\n"
    "\n"
    "# frame FRAME PASSES OUTPUTS\n"
    "define frame\n"
    "render: $(2)\n"
    "post: $(3)\n"
    "$(3) &: frames/$(1)/frame.json $(2)\n"
    "\t@$$(STAFFAGE_POST) . --frame $(1)\n"
    "\t@echo staffage: frame $(1)\n"
    "endef\n"
    "\n"
    "$(foreach f,$(FRAMES),$(foreach p,$(call passes,$(f)),$(eval $(call pass,$(f),$(p)))))\n"
    "$(foreach f,$(FRAMES),$(eval $(call frame,$(f),$(patsubst %,frames/$(f)/%.exr,$(call passes,$(f))),"
    "$(subst %,$(f),$(OUTPUTS)))))\n"
    "\n"
    "# One make would begin every pass before it comes back to a frame that is ready for its picture;\n"
    "# one make a frame finishes it first. They share the jobs, and end with this one.\n"
    "frame-%:\n"
    "\t@setpriv --pdeathsig TERM $(MAKE) FRAMES=$* post\n";

/* POV-Ray 3.7 reads the first section without effect (its parser leaves the value unset), so
 * staffage-povray confines the process as well; a POV-Ray that is mended honours it. */
static const char povray_conf[] =
    "[File I/O Security]\n"
    "restricted\n"
    "[Shellout Security]\n"
    "forbidden\n"
    "[Permitted Paths]\n"
    "read* = .\n"
    "read+write* = frames\n";

static bool is_frame_name(const char *name)
{
    return name[0] && strspn(name, "0123456789") == strlen(name);
}

/* Words that neither make nor a shell would take for anything else. */
static bool is_options(const char *options)
{
    return strspn(options, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-. ") == strlen(options);
}

static void write_values(FILE *f, const struct makefile_frame *frames, size_t frame_count)
{
    fprintf(f, "# Written by staffage-gen. Run inside this folder: make -k -j2 [render|post]\nFRAMES :=");
    for (size_t i = 0; i < frame_count; i++) fprintf(f, " %s", frames[i].name);
    fprintf(f, "\n");
    for (size_t i = 0; i < frame_count; i++)
        for (int p = 0; p < PASS_COUNT && !frames[i].empty; p++) {
            const char *options = frames[i].options[p] ? frames[i].options[p] : "";
            fprintf(f, "%s_%s := %d %d%s%s\n", pass_names[p], frames[i].name, frames[i].width_px[p],
                    frames[i].height_px[p], *options ? " " : "", options);
        }
    fprintf(f, "\n");
}

static bool check_frames(const struct makefile_frame *frames, size_t frame_count, struct error *err)
{
    for (size_t i = 0; i < frame_count; i++) {
        if (!is_frame_name(frames[i].name))
            return error_set(err, ERR_BUG, "makefile: the frame name \"%s\" is not all digits", frames[i].name);
        if (frames[i].empty) continue;
        for (int p = 0; p < PASS_COUNT; p++) {
            if (frames[i].width_px[p] < 1 || frames[i].height_px[p] < 1)
                return error_set(err, ERR_BUG, "makefile: frame %s: a pass of %d x %d pixels", frames[i].name,
                                 frames[i].width_px[p], frames[i].height_px[p]);
            if (frames[i].options[p] && !is_options(frames[i].options[p]))
                return error_set(err, ERR_BUG, "makefile: frame %s: option \"%s\" is not a plain word",
                                 frames[i].name, frames[i].options[p]);
        }
    }
    return true;
}

static bool write_in(const char *out_folder, const char *name, const void *data, size_t size, struct error *err)
{
    char *path = string_format("%s/%s", out_folder, name);
    char *folder = path ? path_folder(path) : NULL;
    bool ok = folder ? folder_make(folder, err) && file_write_if_changed(path, data, size, err)
                     : error_set(err, ERR_MEMORY, "no memory for a path");
    free(folder);
    free(path);
    return ok;
}

static bool copy_template(const char *out_folder, const char *templates_folder, const char *name, struct error *err)
{
    char *from = string_format("%s/%s", templates_folder, name);
    char *to = string_format("templates/%s", name);
    char *data = NULL;
    size_t size;
    bool ok = false;
    if (!from || !to) error_set(err, ERR_MEMORY, "no memory for a path");
    else ok = file_read(&data, &size, from, err) && write_in(out_folder, to, data, size, err);
    free(data);
    free(to);
    free(from);
    return ok;
}

static bool copy_templates(const char *out_folder, const char *templates_folder, struct error *err)
{
    DIR *folder = opendir(templates_folder);
    if (!folder)
        return error_at(err, ERR_IO, templates_folder, 0, 0, "the templates cannot be read: %s", strerror(errno));
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(folder));) {
        const char *ending = strrchr(entry->d_name, '.');
        if (ending && strcmp(ending, ".inc") == 0)
            ok = copy_template(out_folder, templates_folder, entry->d_name, err);
    }
    closedir(folder);
    return ok;
}

bool makefile_write(const char *out_folder, const char *templates_folder,
                    const struct makefile_frame *frames, size_t frame_count, struct error *err)
{
    if (!check_frames(frames, frame_count, err)) return false;
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    if (!f) return error_set(err, ERR_MEMORY, "no memory for the makefile");
    write_values(f, frames, frame_count);
    fputs(rules, f);
    bool ok = !ferror(f);
    if (fclose(f) != 0) ok = false;
    if (!ok) error_set(err, ERR_MEMORY, "no memory for the makefile");
    ok = ok && copy_templates(out_folder, templates_folder, err) &&
         write_in(out_folder, "frames/home/.povray/3.7/povray.conf", povray_conf, sizeof povray_conf - 1, err) &&
         write_in(out_folder, "Makefile", text, size, err);
    free(text);
    return ok;
}
