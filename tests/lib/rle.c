#include "lib/rle.h"

#include "tests/tap.h"

static uint32_t state = 1;
static uint32_t draw(void)
{
    return (state = state * 1664525u + 1013904223u) >> 8;
}

/* The runs of a mask, as text: "1,2,3". */
static const char *runs_text(const struct rle *rle)
{
    static char text[1024];
    size_t used = 0;
    text[0] = 0;
    for (size_t i = 0; i < rle->count; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%u", i ? "," : "", rle->counts[i]);
    return text;
}

/* A whole picture from rows of '.' and '#'. */
static void check(const char *rows, int w, int h, const char *runs, const char *string, const char *what)
{
    struct error err = ERROR_NONE;
    struct rle rle = { 0 }, back = { 0 };
    uint8_t mask[256], decoded[256];
    for (int i = 0; i < w * h; i++) mask[i] = rows[i] == '#';
    OK(rle_encode(&rle, mask, (struct rect){ 0, 0, w, h }, w, h, &err) && !strcmp(runs_text(&rle), runs), "%s: runs %s",
       what, runs);
    char *got = rle_to_string(&rle);
    OK(got && !strcmp(got, string), "%s: string %s (got %s)", what, string, got);
    free(got);
    OK(rle_from_string(&back, string, w, h, &err) && !strcmp(runs_text(&back), runs), "%s: read back", what);
    memset(decoded, 7, sizeof decoded);
    rle_decode(decoded, &back);
    OK(!memcmp(decoded, mask, (size_t)(w * h)), "%s: decoded to the same pixels", what);
    rle_release(&rle);
    rle_release(&back);
}

/* Strings that others published with the masks that they stand for. */
static void published(void)
{
    struct error err = ERROR_NONE;
    struct rle rle = { 0 };
    /* The right upper quarter of 100 x 100: 50 columns of 50 ones after 5000 zeros. */
    char want[128] = "Xl4b1b1";
    memset(want + 7, '0', 98);
    want[7 + 98] = 0;
    uint8_t quarter[50 * 50];
    memset(quarter, 1, sizeof quarter);
    OK(rle_encode(&rle, quarter, (struct rect){ 50, 0, 100, 50 }, 100, 100, &err),
       "a mask that covers a part of the picture");
    char *got = rle_to_string(&rle);
    OK(got && !strcmp(got, want), "the published string of a quarter of 100 x 100 (got %s)", got);
    free(got);
    rle_release(&rle);

    /* Strings in the wild, read and written again. The third's first and last runs are
     * larger than 16 bits, the others' differences have both signs. */
    static const struct {
        const char *string;
        int w, h;
    } wild[] = {
        { "b04500N2", 5, 9 },
        { "724;MG2MN16", 5, 9 },
        { "Q[]17mn06M3L3M3M3M3N2M3M2O2N100O100N20000O100O1000O100000001N10001N101N101N1O2N2N3K4K6G\\Vkk0", 1000, 1000 },
        { "nYW31n>2N2FNbA48Kf=?XBDe=m0OM3M4YOPB8_>L4JXao5", 640, 480 },
    };
    for (size_t i = 0; i < sizeof wild / sizeof *wild; i++) {
        bool ok = rle_from_string(&rle, wild[i].string, wild[i].w, wild[i].h, &err);
        char *again = ok ? rle_to_string(&rle) : NULL;
        OK(ok && again && !strcmp(again, wild[i].string),
           "published string %zu fills its picture and is written the same", i + 1);
        if (i == 0) OK(!strcmp(runs_text(&rle), "18,4,5,4,5,2,7"), "its runs, worked out by hand");
        free(again);
        rle_release(&rle);
    }
}

static void round_trips(void)
{
    bool same = true;
    for (int trial = 0; trial < 300; trial++) {
        int w = 1 + (int)(draw() % 40), h = 1 + (int)(draw() % 40);
        struct rect r = { (int)(draw() % (uint32_t)w), (int)(draw() % (uint32_t)h), 0, 0 };
        r.x1 = r.x0 + (int)(draw() % (uint32_t)(w - r.x0 + 1));
        r.y1 = r.y0 + (int)(draw() % (uint32_t)(h - r.y0 + 1));
        uint8_t part[1600], whole[1600] = { 0 }, decoded[1600];
        uint32_t density = draw() % 5;
        size_t n = 0;
        for (int y = r.y0; y < r.y1; y++)
            for (int x = r.x0; x < r.x1; x++) whole[y * w + x] = part[n++] = density == 4 || draw() % 4 < density;
        struct error err = ERROR_NONE;
        struct rle rle = { 0 }, back = { 0 };
        same = same && rle_encode(&rle, part, r, w, h, &err);
        char *string = rle_to_string(&rle);
        same = same && rle_from_string(&back, string, w, h, &err);
        rle_decode(decoded, &back);
        uint64_t area = 0;
        for (int i = 0; i < w * h; i++) area += whole[i];
        same = same && !memcmp(decoded, whole, (size_t)(w * h)) && rle_area(&back) == area;
        for (size_t i = 1; i < rle.count; i++) same = same && rle.counts[i] > 0;
        free(string);
        rle_release(&rle);
        rle_release(&back);
    }
    OK(same, "300 random parts of pictures come back pixel by pixel, with no empty run but the first");
}

static void refuses(const char *string, int w, int h, const char *text)
{
    struct error err = ERROR_NONE;
    struct rle rle = { 0 };
    bool ok = rle_from_string(&rle, string, w, h, &err);
    OK(!ok && err.code == ERR_INPUT && !strcmp(err.text, text) && !rle.counts, "refuses \"%s\": %s", string, err.text);
}

int main(void)
{
    check("......", 3, 2, "6", "6", "nothing");
    check("######", 3, 2, "0,6", "06", "everything");
    /* column-major: . # | # # | . . */
    check(".#."
          "##.",
          3, 2, "1,3,2", "132", "an L");
    /* runs 2,1,2,1,3 : differences from the fourth on: 1-1, 3-2 */
    check("..."
          "..."
          "##.",
          3, 3, "2,1,2,1,3", "21201", "a foot");
    /* 16 has the sign bit set, so it takes two groups; 14 - 16 = -2 takes one, 30 + 48 = 'N' */
    check("####.####"
          "####.####"
          "####.###."
          "####.###.",
          9, 4, "0,16,4,14,2", "0`04NN", "a column taken out");
    published();
    round_trips();
    refuses("Z", 3, 2, "a mask string ends within a number at byte 2");
    refuses("1 4", 3, 2, "byte 2 of a mask string is out of place");
    refuses("133", 3, 2, "run 3 of a mask string does not fit into 3 x 2 pixels");
    refuses("12", 3, 2, "a mask string fills 3 pixels of 3 x 2");
    refuses("131L", 3, 2, "run 4 of a mask string does not fit into 3 x 2 pixels");
    refuses("", 3, 2, "a mask string fills 0 pixels of 3 x 2");
    refuses("PPPPPPPP1", 3, 2, "byte 8 of a mask string is out of place");
    return tap_done();
}
