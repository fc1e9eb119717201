#include "gen/render/sdl.h"

#include "tests/tap.h"

static bool text_is(struct sdl *sdl, const char *want)
{
    bool same = sdl->text && !strcmp(sdl->text, want);
    if (!same) printf("# got: %s\n", sdl->text ? sdl->text : "(nothing)");
    sdl_release(sdl);
    return same;
}

int main(void)
{
    struct sdl sdl;
    struct error err = ERROR_NONE;
    sdl_init(&sdl);
    sdl_declare_vector(&sdl, "A", vec3(1, -0.1, 1e-9));
    OK(text_is(&sdl, "#declare A = <1,-0.1,1e-09>;\n"), "a declared vector");

    sdl_declare_string(&sdl, "Name", "x\" #fopen F \"/tmp/y\\z\" write");
    OK(text_is(&sdl, "#declare Name = \"x\\\" #fopen F \\\"/tmp/y\\\\z\\\" write\";\n"),
       "quotes and backslashes in a string are escaped");

    sdl_string(&sdl, "two\nlines");
    OK(sdl.err.code == ERR_INPUT, "a control character in a string is refused");
    OK(!sdl_write(&sdl, "never-written.pov", &err) && err.code == ERR_INPUT, "and nothing is written");
    sdl_release(&sdl);

    sdl_number(&sdl, 0.0 / 0.0);
    OK(sdl.err.code == ERR_BUG, "NaN is refused");
    sdl_release(&sdl);
    sdl_number(&sdl, 1.0 / 0.0);
    OK(sdl.err.code == ERR_BUG, "infinity is refused");
    sdl_release(&sdl);
    sdl_word(&sdl, "union } #include");
    OK(sdl.err.code == ERR_BUG, "what is no word is refused");
    sdl_release(&sdl);

    err = ERROR_NONE;
    sdl_begin(&sdl, "union");
    OK(!sdl_write(&sdl, "never-written.pov", &err) && err.code == ERR_BUG, "a block without end is refused");
    sdl_release(&sdl);

    struct pose turn = { { { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } } }, { 4, 5, 6 } };
    sdl_matrix(&sdl, turn);
    OK(text_is(&sdl, "matrix <0,1,0,-1,0,0,0,0,1,4,5,6>\n"),
       "a pose is written as POV-Ray multiplies: x goes to y, a row each for the images of the axes");

    sdl_begin(&sdl, "mesh2");
    sdl_call(&sdl, "Finish", (double[]){ 0.5, 1 }, 2);
    sdl_end(&sdl);
    OK(text_is(&sdl, "mesh2 {\n  Finish(0.5, 1)\n}\n"), "blocks are indented");
    return tap_done();
}
