#include "lib/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *string_format(const char *format, ...)
{
    va_list args;
    char *text = NULL;
    va_start(args, format);
    if (vasprintf(&text, format, args) < 0) text = NULL;
    va_end(args);
    return text;
}

char *path_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash) return strdup(".");
    if (slash == path) return strdup("/");
    return strndup(path, (size_t)(slash - path));
}

char *path_beside(const char *base_file, const char *path)
{
    if (path[0] == '/') return strdup(path);
    const char *slash = strrchr(base_file, '/');
    if (!slash) return strdup(path);
    return string_format("%.*s/%s", (int)(slash - base_file), base_file, path);
}

char *path_from_folder(const char *folder, const char *path)
{
    return path[0] == '/' ? strdup(path) : string_format("%s/%s", folder, path);
}

const char *path_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool file_exists(const char *path)
{
    struct stat st;
    return stat(path, &st) == 0 && S_ISREG(st.st_mode);
}

bool file_read(char **data, size_t *size, const char *path, struct error *err)
{
    FILE *f = fopen(path, "rb");
    if (!f) return error_at(err, ERR_INPUT, path, 0, 0, "cannot be opened: %s", strerror(errno));
    char *bytes = NULL;
    struct stat st;
    if (fstat(fileno(f), &st) != 0 || !S_ISREG(st.st_mode)) {
        error_at(err, ERR_INPUT, path, 0, 0, "is not a file");
        goto out;
    }
    size_t n = (size_t)st.st_size;
    bytes = malloc(n + 1);
    if (!bytes) {
        error_at(err, ERR_MEMORY, path, 0, 0, "no memory for %zu bytes", n);
        goto out;
    }
    if (fread(bytes, 1, n, f) != n) {
        error_at(err, ERR_IO, path, 0, 0, "cannot be read: %s", strerror(errno));
        goto out;
    }
    bytes[n] = 0;
    *data = bytes;
    *size = n;
    bytes = NULL;
out:
    free(bytes);
    fclose(f);
    return err->code == ERR_OK;
}

bool file_commit(const char *temporary, const char *path, struct error *err)
{
    int fd = open(temporary, O_RDONLY);
    bool ok = fd >= 0 && fsync(fd) == 0;
    if (fd >= 0) close(fd);
    if (ok && rename(temporary, path) == 0) return true;
    int cause = errno;
    unlink(temporary);
    return error_at(err, ERR_IO, path, 0, 0, "cannot be written: %s", strerror(cause));
}

char *file_temporary(const char *path)
{
    const char *name = path_name(path), *dot = strrchr(name, '.');
    return string_format("%.*s.%s.%ld.tmp%s", (int)(name - path), path, name, (long)getpid(), dot ? dot : "");
}

bool file_write(const char *path, const void *data, size_t size, struct error *err)
{
    char *temporary = file_temporary(path);
    if (!temporary) return error_set(err, ERR_MEMORY, "no memory for a path");
    bool ok = false;
    FILE *f = fopen(temporary, "wb");
    if (!f) {
        error_at(err, ERR_IO, path, 0, 0, "cannot be written: %s", strerror(errno));
        goto out;
    }
    bool written = fwrite(data, 1, size, f) == size;
    int cause = errno;
    if (fclose(f) != 0 && written) {
        written = false;
        cause = errno;
    }
    if (!written) {
        unlink(temporary);
        error_at(err, ERR_IO, path, 0, 0, "cannot be written: %s", strerror(cause));
        goto out;
    }
    ok = file_commit(temporary, path, err);
out:
    free(temporary);
    return ok;
}

bool file_write_if_changed(const char *path, const void *data, size_t size, struct error *err)
{
    struct error ignored = ERROR_NONE;
    char *old = NULL;
    size_t old_size = 0;
    if (file_exists(path) && file_read(&old, &old_size, path, &ignored) && old_size == size &&
        memcmp(old, data, size) == 0) {
        free(old);
        return true;
    }
    free(old);
    return file_write(path, data, size, err);
}

bool file_copy(const char *to, const char *from, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(&data, &size, from, err)) return false;
    bool ok = file_write(to, data, size, err);
    free(data);
    return ok;
}

bool folder_make(const char *path, struct error *err)
{
    char *part = strdup(path);
    if (!part) return error_set(err, ERR_MEMORY, "no memory for a path");
    for (char *c = part + 1;; c++) {
        if (*c != '/' && *c != 0) continue;
        char end = *c;
        *c = 0;
        if (mkdir(part, 0777) != 0 && errno != EEXIST) {
            error_at(err, ERR_IO, part, 0, 0, "folder cannot be made: %s", strerror(errno));
            break;
        }
        *c = end;
        if (!end) break;
    }
    struct stat st;
    if (err->code == ERR_OK && (stat(path, &st) != 0 || !S_ISDIR(st.st_mode)))
        error_at(err, ERR_IO, path, 0, 0, "is not a folder");
    free(part);
    return err->code == ERR_OK;
}

uint64_t hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    const uint64_t prime = 0x100000001b3u;
    for (; size >= sizeof(uint64_t); size -= sizeof(uint64_t), bytes += sizeof(uint64_t)) {
        uint64_t word;
        memcpy(&word, bytes, sizeof word);
        hash = (hash ^ word) * prime;
        hash ^= hash >> 29; /* a product moves bits up only */
    }
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * prime;
    return hash;
}

bool file_hash(uint64_t *hash, const char *path, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(&data, &size, path, err)) return false;
    *hash = hash_bytes(*hash, data, size);
    free(data);
    return true;
}
