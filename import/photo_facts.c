#include "import/photo_facts.h"

#include <libexif/exif-data.h>
#include <libexif/exif-log.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the segment of the JPEG that holds EXIF ---- */

/* What precedes the picture in a JPEG is a list of segments, each with a marker and its length.
 * Out: *data (the caller frees), NULL where there is no EXIF */
static bool read_segment(unsigned char **data, unsigned *size, FILE *f, const char *path, struct error *err)
{
    *data = NULL;
    if (fgetc(f) != 0xff || fgetc(f) != 0xd8) return true;
    for (;;) {
        int marker = fgetc(f);
        if (marker != 0xff) return true;
        while (marker == 0xff) marker = fgetc(f);
        if (marker == EOF || marker == 0xda || marker == 0xd9) return true;
        int high = fgetc(f), low = fgetc(f);
        if (high == EOF || low == EOF) return true;
        unsigned length = (unsigned)high << 8 | (unsigned)low;
        if (length < 2) return true;
        length -= 2;
        if (marker != 0xe1) {
            if (fseek(f, (long)length, SEEK_CUR) != 0) return true;
            continue;
        }
        unsigned char *bytes = malloc(length + 1);
        if (!bytes) return error_at(err, ERR_MEMORY, path, 0, 0, "no memory for %u bytes", length);
        size_t got = fread(bytes, 1, length, f);
        bool is_exif = got >= 6 && !memcmp(bytes, "Exif\0", 6);
        if (is_exif && got == length) {
            *data = bytes;
            *size = length;
            return true;
        }
        free(bytes);
        if (is_exif)
            return error_at(err, ERR_INPUT, path, 0, 0, "EXIF is truncated: %u bytes are announced, %zu are there", length, got);
    }
}

/* After "Exif" comes a TIFF header: byte order, 42, where the first directory is. libexif reads nothing where
 * that leads nowhere, and says nothing. */
static bool has_directory(const unsigned char *data, unsigned size)
{
    if (size < 14) return false;
    ExifByteOrder order = data[6] == 'M' ? EXIF_BYTE_ORDER_MOTOROLA : EXIF_BYTE_ORDER_INTEL;
    return exif_get_long(data + 10, order) <= size - 8;
}

/* ---- entries ---- */

struct reader { const char *path; ExifData *exif; ExifByteOrder order; struct error *err; };

static bool broken(const struct reader *r, const char *what, const char *why)
{
    return error_at(r->err, ERR_INPUT, r->path, 0, 0, "EXIF: %s %s", what, why);
}

/* NULL where there is none or one that holds less than `components` of a format. */
static const ExifEntry *entry(const struct reader *r, ExifIfd ifd, int tag, ExifFormat format, unsigned long components)
{
    const ExifEntry *e = exif_content_get_entry(r->exif->ifd[ifd], (ExifTag)tag);
    if (!e || e->format != format || e->components < components) return NULL;
    return e->size >= components * exif_format_get_size(format) ? e : NULL;
}

/* Rationals as numbers. Returns false where there are none or, as cameras write what they do not know, 0/0. */
static bool rationals(double *values, const struct reader *r, ExifIfd ifd, int tag, unsigned n)
{
    const ExifEntry *e = entry(r, ifd, tag, EXIF_FORMAT_RATIONAL, n);
    if (!e) return false;
    for (unsigned i = 0; i < n; i++) {
        ExifRational q = exif_get_rational(e->data + 8 * i, r->order);
        if (q.denominator == 0) return false;
        values[i] = (double)q.numerator / (double)q.denominator;
    }
    return true;
}

/* Out: text, ended by NUL; returns false where there is none or only blanks. */
static bool ascii(char *text, size_t size, const struct reader *r, ExifIfd ifd, int tag)
{
    const ExifEntry *e = entry(r, ifd, tag, EXIF_FORMAT_ASCII, 1);
    if (!e) return false;
    size_t n = e->size < size - 1 ? e->size : size - 1;
    memcpy(text, e->data, n);
    text[n] = 0;
    return text[strspn(text, " ")] != 0;
}

/* ---- facts ---- */

/* Degrees of latitude or longitude. Returns false where there are none, or with the error set. */
static bool angle(double *deg, const struct reader *r, int tag, int reference_tag, const char *what, const char *letters,
                  double limit)
{
    double dms[3];
    if (!rationals(dms, r, EXIF_IFD_GPS, tag, 3)) return false;
    char reference[4] = "";
    ascii(reference, sizeof reference, r, EXIF_IFD_GPS, reference_tag);
    char why[80];
    if (reference[0] != letters[0] && reference[0] != letters[1]) {
        snprintf(why, sizeof why, "has \"%s\" beside it; it must be %c or %c", reference, letters[0], letters[1]);
        return broken(r, what, why);
    }
    double value = dms[0] + dms[1] / 60 + dms[2] / 3600;
    if (value > limit) {
        snprintf(why, sizeof why, "is %.9g deg; there is none beyond %g", value, limit);
        return broken(r, what, why);
    }
    *deg = reference[0] == letters[0] ? value : -value;
    return true;
}

static void read_position(struct photo_facts *facts, const struct reader *r)
{
    char status[4];
    if (ascii(status, sizeof status, r, EXIF_IFD_GPS, EXIF_TAG_GPS_STATUS) && status[0] == 'V') return; /* no fix */
    double *place = facts->lat_lon_h;
    facts->has_position = angle(&place[0], r, EXIF_TAG_GPS_LATITUDE, EXIF_TAG_GPS_LATITUDE_REF, "GPS latitude", "NS", 90)
        && angle(&place[1], r, EXIF_TAG_GPS_LONGITUDE, EXIF_TAG_GPS_LONGITUDE_REF, "GPS longitude", "EW", 180);
    if (!facts->has_position) {
        place[0] = place[1] = 0;
        return;
    }
    facts->has_height = rationals(&place[2], r, EXIF_IFD_GPS, EXIF_TAG_GPS_ALTITUDE, 1);
    const ExifEntry *e = entry(r, EXIF_IFD_GPS, EXIF_TAG_GPS_ALTITUDE_REF, EXIF_FORMAT_BYTE, 1);
    /* 1: below sea level; 3, since EXIF 3.0: below the ellipsoid */
    if (facts->has_height && e && (e->data[0] == 1 || e->data[0] == 3)) place[2] = -place[2];
}

/* True when text has the shape of a pattern in which 0 stands for any digit. */
static bool has_shape(const char *text, const char *pattern)
{
    for (; *pattern; text++, pattern++)
        if (*pattern == '0' ? *text < '0' || *text > '9' : *text != *pattern) return false;
    return *text == 0 || *text == ' ';
}

static bool read_time(struct photo_facts *facts, const struct reader *r)
{
    char text[32], why[100];
    if (!ascii(text, sizeof text, r, EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL)) return true;
    if (!strncmp(text, "0000", 4) || !strncmp(text, "    ", 4)) return true; /* a clock that was never set */
    if (!has_shape(text, "0000:00:00 00:00:00")) {
        snprintf(why, sizeof why, "is \"%s\"; it must be YYYY:MM:DD HH:MM:SS", text);
        return broken(r, "DateTimeOriginal", why);
    }
    snprintf(facts->time, sizeof facts->time, "%.4s-%.2s-%.2sT%.8s", text, text + 5, text + 8, text + 11);
    facts->has_time = true;
    if (!ascii(text, sizeof text, r, EXIF_IFD_EXIF, EXIF_TAG_OFFSET_TIME_ORIGINAL) || text[0] == ' ') return true;
    if (!has_shape(text, "+00:00") && !has_shape(text, "-00:00")) {
        snprintf(why, sizeof why, "is \"%s\"; it must be +HH:MM or -HH:MM", text);
        return broken(r, "OffsetTimeOriginal", why);
    }
    snprintf(facts->offset, sizeof facts->offset, "%.6s", text);
    return true;
}

static void read_lens(struct photo_facts *facts, const struct reader *r)
{
    double value;
    if (rationals(&value, r, EXIF_IFD_EXIF, EXIF_TAG_EXPOSURE_TIME, 1) && value > 0) {
        facts->exposure_s = value;
        facts->has_exposure = true;
    }
    if (rationals(&value, r, EXIF_IFD_EXIF, EXIF_TAG_FNUMBER, 1)) facts->f_number = value;
    if (rationals(&value, r, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH, 1)) facts->focal_mm = value;
    const ExifEntry *e = entry(r, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM, EXIF_FORMAT_SHORT, 1);
    if (e) facts->focal_35mm = exif_get_short(e->data, r->order);
}

/* ---- all of it ---- */

struct complaint { bool made; char text[200]; };

/* Makers' private notes are their own affair: only complaints about EXIF itself count. */
__attribute__((format(printf, 4, 0)))
static void complain(ExifLog *log, ExifLogCode code, const char *domain, const char *format, va_list args, void *data)
{
    (void)log;
    struct complaint *complaint = data;
    if (complaint->made || code != EXIF_LOG_CODE_CORRUPT_DATA || strncmp(domain, "ExifData", 8)) return;
    complaint->made = true;
    vsnprintf(complaint->text, sizeof complaint->text, format, args);
}

bool photo_facts_read(struct photo_facts *facts, const char *path, struct error *err)
{
    unsigned char *data = NULL;
    unsigned size = 0;
    FILE *f = fopen(path, "rb");
    if (!f) return error_at(err, ERR_INPUT, path, 0, 0, "cannot be opened: %s", strerror(errno));
    bool good = read_segment(&data, &size, f, path, err);
    fclose(f);
    struct photo_facts found = { 0 };
    if (!good || !data) {
        if (good) *facts = found;
        return good;
    }

    struct complaint complaint = { 0 };
    ExifLog *log = exif_log_new();
    ExifData *exif = exif_data_new();
    if (!log || !exif) {
        good = error_at(err, ERR_MEMORY, path, 0, 0, "no memory for its EXIF");
        goto out;
    }
    exif_log_set_func(log, complain, &complaint);
    exif_data_log(exif, log);
    /* Follow the specification: libexif would then put defaults where nothing is, the time of day among them. */
    exif_data_unset_option(exif, EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
    if (!has_directory(data, size)) {
        good = error_at(err, ERR_INPUT, path, 0, 0, "EXIF is broken: its first directory is not in it");
        goto out;
    }
    exif_data_load_data(exif, data, size);
    struct reader reader = { path, exif, exif_data_get_byte_order(exif), err };
    if (complaint.made) {
        good = error_at(err, ERR_INPUT, path, 0, 0, "EXIF is broken: %s", complaint.text);
        goto out;
    }
    read_position(&found, &reader);
    read_lens(&found, &reader);
    good = err->code == ERR_OK && read_time(&found, &reader);
    if (good) *facts = found;
out:
    free(data);
    if (exif) exif_data_unref(exif);
    if (log) exif_log_unref(log);
    return good;
}
