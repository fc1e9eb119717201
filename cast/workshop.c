#include "cast/workshop.h"

#include "cast/figure.h"
#include "cast/fleet.h"
#include "cast/listing.h"
#include "lib/file.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_HANDS = 64 };

struct job {
    int model;               /* vehicles are counted first, then people */
    struct listing listing;
    struct error err;
};
struct workshop {
    const char *folder;
    struct job *job;         /* (jobs) */
    int jobs;
    atomic_int next;
};

static int model_count(void) { return fleet_count() + people_count; }

static const char *model_name(int model)
{
    return model < fleet_count() ? fleet_vehicle(model)->name : people[model - fleet_count()].name;
}

/* A vehicle or person is made of its own numbers alone: who makes it when does not matter. */
static void *work(void *of)
{
    struct workshop *w = of;
    for (int i; (i = atomic_fetch_add(&w->next, 1)) < w->jobs;) {
        struct job *j = &w->job[i];
        if (j->model < fleet_count()) write_listed_vehicle(&j->listing, fleet_vehicle(j->model), w->folder, &j->err);
        else write_person(&j->listing, &people[j->model - fleet_count()], w->folder, &j->err);
    }
    return NULL;
}

static bool choose(struct workshop *w, const char *const *name, int names, struct error *err)
{
    for (int model = 0; model < model_count(); model++) {
        bool wanted = names == 0;
        for (int k = 0; k < names; k++) wanted = wanted || strcmp(name[k], model_name(model)) == 0;
        if (wanted) w->job[w->jobs++] = (struct job){ .model = model, .err = ERROR_NONE };
    }
    for (int k = 0; k < names; k++) {
        int model = 0;
        while (model < model_count() && strcmp(name[k], model_name(model)) != 0) model++;
        if (model == model_count()) return error_set(err, ERR_INPUT, "nobody in the cast is called \"%s\"", name[k]);
    }
    return true;
}

/* Who cannot be hired leaves the others more to do. */
static void run(struct workshop *w)
{
    pthread_t hand[MOST_HANDS];
    int hands = 0;
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    while (hands < MOST_HANDS && hands + 1 < cores && hands + 1 < w->jobs && pthread_create(&hand[hands], NULL, work, w) == 0) hands++;
    work(w);
    while (hands > 0) pthread_join(hand[--hands], NULL);
}

bool workshop_run(const char *folder, const char *const *name, int names, struct error *err)
{
    struct workshop w = { .folder = folder, .job = calloc((size_t)model_count(), sizeof *w.job) };
    bool good = w.job ? true : error_set(err, ERR_MEMORY, "no memory for a list of models");
    good = good && choose(&w, name, names, err) && folder_make(folder, err);
    if (good) run(&w);
    struct listing all = { 0 };
    for (int i = 0; i < w.jobs; i++) {
        if (good && w.job[i].err.code != ERR_OK) {
            *err = w.job[i].err;
            good = false;
        }
        good = listing_append(&all, &w.job[i].listing, err) && good;
    }
    good = good && listing_write(&all, folder, err);
    listing_release(&all);
    free(w.job);
    return good;
}
