#include "import/photo_facts.h"
#include "lib/file.h"

#include "tests/tap.h"

#include <libexif/exif-data.h>
#include <unistd.h>

static char path[] = "photo-facts-XXXXXX";
static struct error err;
static struct photo_facts facts;

/* ---- EXIF made by libexif, in as little of a JPEG as holds it ---- */

static ExifData *exif_start(void)
{
    ExifData *exif = exif_data_new();
    exif_data_unset_option(exif, EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
    exif_data_set_byte_order(exif, EXIF_BYTE_ORDER_INTEL);
    return exif;
}

static unsigned char *put(ExifData *exif, ExifIfd ifd, int tag, ExifFormat format, unsigned components)
{
    ExifEntry *e = exif_entry_new();
    e->tag = (ExifTag)tag;
    e->format = format;
    e->components = components;
    e->size = components * exif_format_get_size(format);
    e->data = calloc(1, e->size);
    exif_content_add_entry(exif->ifd[ifd], e);
    unsigned char *data = e->data;
    exif_entry_unref(e);
    return data;
}

static void put_text(ExifData *exif, ExifIfd ifd, int tag, const char *text)
{
    size_t size = strlen(text) + 1;
    memcpy(put(exif, ifd, tag, EXIF_FORMAT_ASCII, (unsigned)size), text, size);
}

static void put_rationals(ExifData *exif, ExifIfd ifd, int tag, const unsigned (*q)[2], unsigned n)
{
    unsigned char *data = put(exif, ifd, tag, EXIF_FORMAT_RATIONAL, n);
    for (unsigned i = 0; i < n; i++)
        exif_set_rational(data + 8 * i, exif_data_get_byte_order(exif), (ExifRational){ q[i][0], q[i][1] });
}

/* Rio de Janeiro: 22 deg 57' 6.75" S, 43 deg 12' 37.5" W, written as cameras do, in several ways. */
static void put_place(ExifData *exif, const char *ns, const char *ew, int height_reference)
{
    const unsigned latitude[3][2] = { { 22, 1 }, { 57, 1 }, { 675, 100 } };
    const unsigned longitude[3][2] = { { 43, 1 }, { 12625, 1000 }, { 0, 1 } };
    const unsigned height[1][2] = { { 415, 10 } };
    if (ns) put_text(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_LATITUDE_REF, ns);
    put_rationals(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_LATITUDE, latitude, 3);
    if (ew) put_text(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_LONGITUDE_REF, ew);
    put_rationals(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_LONGITUDE, longitude, 3);
    if (height_reference < 0) return;
    *put(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_ALTITUDE_REF, EXIF_FORMAT_BYTE, 1) = (unsigned char)height_reference;
    put_rationals(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_ALTITUDE, height, 1);
}

/* Writes a file and reads its facts; frees exif. lacking: bytes that its EXIF ends too early;
 * spoilt_at: where in the EXIF four bytes are wrong, 0: nowhere. */
static bool read_back(ExifData *exif, unsigned lacking, unsigned spoilt_at)
{
    unsigned char *data = NULL;
    unsigned size = 0;
    exif_data_save_data(exif, &data, &size);
    exif_data_unref(exif);
    unsigned char *file = calloc(1, size + 64);
    const unsigned char head[] = { 0xff, 0xd8, 0xff, 0xe0, 0, 4, 'x', 'x', 0xff, 0xe1 };
    memcpy(file, head, sizeof head);
    file[10] = (unsigned char)((size + 2) >> 8);
    file[11] = (unsigned char)((size + 2) & 0xff);
    memcpy(file + 12, data, size);
    if (spoilt_at) memset(file + 12 + spoilt_at, 0xff, 4);
    memcpy(file + 12 + size, "\xff\xd9", 2);
    struct error ignored = ERROR_NONE;
    file_write(path, file, lacking ? 12 + size - lacking : 14 + size, &ignored);
    free(file);
    free(data);
    err = ERROR_NONE;
    return photo_facts_read(&facts, path, &err);
}

/* A failure that names the file, says `because`, and leaves the result alone. */
static bool refused(bool good, const char *because)
{
    bool right = !good && err.code == ERR_INPUT && !strcmp(err.file, path) && strstr(err.text, because);
    if (!right) printf("# %s: %s\n", err.file, good ? "accepted" : err.text);
    return right;
}

static void check_hemispheres(void)
{
    static const struct { const char *ns, *ew; double north, east; } quarters[] = {
        { "N", "E", 1, 1 }, { "S", "W", -1, -1 }, { "N", "W", 1, -1 }, { "S", "E", -1, 1 },
    };
    for (int i = 0; i < 4; i++) {
        ExifData *exif = exif_start();
        if (i == 2) exif_data_set_byte_order(exif, EXIF_BYTE_ORDER_MOTOROLA);
        put_place(exif, quarters[i].ns, quarters[i].ew, 0);
        OK(read_back(exif, 0, 0) && facts.has_position && facts.has_height, "%s %s: a place is there", quarters[i].ns, quarters[i].ew);
        NEAR(facts.lat_lon_h[0], quarters[i].north * 22.951875, 1e-12, "%s: latitude, with seconds", quarters[i].ns);
        NEAR(facts.lat_lon_h[1], quarters[i].east * (43 + 12.625 / 60), 1e-12, "%s: longitude, with parts of minutes", quarters[i].ew);
    }
    static const double heights[] = { 41.5, -41.5, 41.5, -41.5 };
    for (int reference = 0; reference < 4; reference++) {
        ExifData *exif = exif_start();
        put_place(exif, "S", "W", reference);
        OK(read_back(exif, 0, 0) && facts.has_height && facts.lat_lon_h[2] == heights[reference], "altitude reference %d: %g m",
           reference, heights[reference]);
    }
}

static void check_missing(void)
{
    ExifData *exif = exif_start();
    put_text(exif, EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL, "2016:06:23 16:31:59");
    OK(read_back(exif, 0, 0) && !facts.has_position && !facts.has_height && facts.has_time && !facts.has_exposure,
       "EXIF without GPS has no place");
    OK(!strcmp(facts.time, "2016-06-23T16:31:59") && !facts.offset[0], "the time is ISO 8601, without an offset that is not there");

    exif = exif_start();
    put_place(exif, "S", "W", -1);
    OK(read_back(exif, 0, 0) && facts.has_position && !facts.has_height && !facts.has_time,
       "a place without altitude, and no time made up");

    exif = exif_start();
    put_place(exif, "S", "W", 0);
    put_text(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_STATUS, "V");
    OK(read_back(exif, 0, 0) && !facts.has_position, "a receiver without a fix has no place");

    exif = exif_start();
    put_rationals(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_LATITUDE, (const unsigned[3][2]){ { 0, 0 }, { 0, 0 }, { 0, 0 } }, 3);
    OK(read_back(exif, 0, 0) && !facts.has_position, "nor has 0/0");

    exif = exif_start();
    put_text(exif, EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL, "    :  :     :  :  ");
    OK(read_back(exif, 0, 0) && !facts.has_time, "a clock that was never set has no time");

    struct error ignored = ERROR_NONE;
    static const struct { const char *what, *bytes; size_t size; } plain[] = {
        { "a JPEG without EXIF", "\xff\xd8\xff\xdb\0\4ab\xff\xd9", 10 },
        { "a PNG", "\x89PNG\r\n\x1a\n", 8 },
        { "an empty file", "", 0 },
        { "XMP alone", "\xff\xd8\xff\xe1\0\x0chttp://ns.\xff\xd9", 16 },
    };
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
        file_write(path, plain[i].bytes, plain[i].size, &ignored);
        memset(&facts, 1, sizeof facts);
        err = ERROR_NONE;
        OK(photo_facts_read(&facts, path, &err) && !facts.has_position && !facts.has_time && !facts.has_exposure, "%s says nothing",
           plain[i].what);
    }
}

static void check_lens(void)
{
    ExifData *exif = exif_start();
    put_rationals(exif, EXIF_IFD_EXIF, EXIF_TAG_EXPOSURE_TIME, (const unsigned[1][2]){ { 1, 250 } }, 1);
    put_rationals(exif, EXIF_IFD_EXIF, EXIF_TAG_FNUMBER, (const unsigned[1][2]){ { 28, 10 } }, 1);
    put_rationals(exif, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH, (const unsigned[1][2]){ { 361, 100 } }, 1);
    exif_set_short(put(exif, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM, EXIF_FORMAT_SHORT, 1), EXIF_BYTE_ORDER_INTEL, 24);
    put_text(exif, EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL, "2021:12:31 23:59:58");
    put_text(exif, EXIF_IFD_EXIF, EXIF_TAG_OFFSET_TIME_ORIGINAL, "-03:30");
    OK(read_back(exif, 0, 0) && facts.has_exposure && facts.exposure_s == 0.004 && facts.f_number == 2.8 && facts.focal_mm == 3.61
           && facts.focal_35mm == 24, "exposure, aperture and focal lengths");
    OK(!strcmp(facts.time, "2021-12-31T23:59:58") && !strcmp(facts.offset, "-03:30"), "the time and its offset");
}

static void check_broken(void)
{
    ExifData *exif = exif_start();
    put_place(exif, NULL, "W", 0);
    facts.exposure_s = 42;
    OK(refused(read_back(exif, 0, 0), "must be N or S"), "a latitude without N or S is refused");
    OK(facts.exposure_s == 42, "a refusal leaves the result alone");
    exif = exif_start();
    put_place(exif, "N", "O", 0);
    OK(refused(read_back(exif, 0, 0), "GPS longitude has \"O\" beside it; it must be E or W"), "so is a German's east");
    exif = exif_start();
    put_text(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_LATITUDE_REF, "N");
    put_rationals(exif, EXIF_IFD_GPS, EXIF_TAG_GPS_LATITUDE, (const unsigned[3][2]){ { 97, 1 }, { 0, 1 }, { 0, 1 } }, 3);
    OK(refused(read_back(exif, 0, 0), "97 deg"), "a latitude of 97 deg is refused");
    exif = exif_start();
    put_text(exif, EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL, "2016-06-23T16:31:59");
    OK(refused(read_back(exif, 0, 0), "YYYY:MM:DD"), "a time of another shape is refused");
    exif = exif_start();
    put_text(exif, EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL, "2016:06:23 16:31:59");
    put_text(exif, EXIF_IFD_EXIF, EXIF_TAG_OFFSET_TIME_ORIGINAL, "CDT");
    OK(refused(read_back(exif, 0, 0), "OffsetTimeOriginal is \"CDT\""), "an offset of another shape is refused");

    exif = exif_start();
    put_place(exif, "S", "W", 0);
    OK(refused(read_back(exif, 20, 0), "truncated"), "a file that ends in the middle of its EXIF is refused");
    exif = exif_start();
    put_place(exif, "S", "W", 0);
    OK(refused(read_back(exif, 0, 10), "broken"), "EXIF whose first directory lies nowhere is refused");
    exif = exif_start();
    put_place(exif, "S", "W", 0);
    OK(refused(read_back(exif, 0, 6), "broken"), "EXIF of no byte order is refused");
}

/* Figures by exiftool 12.57. */
static void check_brighton(void)
{
    const char *shared = tap_shared();
    if (!shared) {
        SKIP("brighton's EXIF", "no shared folder");
        return;
    }
    char *photograph = string_format("%s/data/brighton/images/DJI_0018.JPG", shared);
    err = ERROR_NONE;
    OK(photo_facts_read(&facts, photograph, &err) && facts.has_position && facts.has_height && facts.has_time && facts.has_exposure,
       "brighton: a drone's picture has all facts");
    NEAR(facts.lat_lon_h[0], 46.8426070833333, 1e-9, "brighton: latitude");
    NEAR(facts.lat_lon_h[1], -91.9945598888889, 1e-9, "brighton: longitude");
    NEAR(facts.lat_lon_h[2], 198.309, 1e-9, "brighton: altitude");
    OK(!strcmp(facts.time, "2016-06-23T16:31:59") && !facts.offset[0], "brighton: local time, no offset");
    NEAR(facts.exposure_s, 0.002702, 1e-9, "brighton: exposure");
    OK(facts.f_number == 2.8 && fabs(facts.focal_mm - 3.61) < 1e-9 && facts.focal_35mm == 20,
       "brighton: aperture and focal lengths");
    free(photograph);
}

int main(void)
{
    int file = mkstemp(path);
    if (file >= 0) close(file);
    check_hemispheres();
    check_missing();
    check_lens();
    check_broken();
    unlink(path);
    err = ERROR_NONE;
    OK(refused(photo_facts_read(&facts, path, &err), "cannot be opened"), "a photograph that is missing is named");
    check_brighton();
    return tap_done();
}
