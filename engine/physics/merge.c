#include "engine/core/vector.h"
#include "engine/physics/internal.h"

/* What makes a body stand is the outline of its contacts: of each face, the corners are kept and what lies between is not. */

enum { FACES_MAX = 4, FACE_CORNERS = 4 };

static double same_direction(const dContactGeom *a, const dContactGeom *b)
{
    return nook_vector_dot(a->normal, b->normal);
}

static void swap(dContactGeom *contacts, uint32_t i, uint32_t j)
{
    dContactGeom t = contacts[i];
    contacts[i] = contacts[j];
    contacts[j] = t;
}

static uint32_t drop_broken(dContactGeom *contacts, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        double length = nook_vector_length(contacts[i].normal);
        if (fabs(length - 1.0) < 1e-3 && contacts[i].depth >= 0.0 && isfinite(contacts[i].depth)) /* false for NaN */
            contacts[kept++] = contacts[i];
    }
    return kept;
}

static uint32_t deepest(const dContactGeom *contacts, uint32_t first, uint32_t end)
{
    uint32_t best = first;
    for (uint32_t i = first + 1; i < end; i++)
        if (contacts[i].depth > contacts[best].depth)
            best = i;
    return best;
}

/* Brings what faces the same way as contacts[first] behind it. @return the end of that face */
static uint32_t gather_face(dContactGeom *contacts, uint32_t first, uint32_t count)
{
    uint32_t end = first + 1;
    for (uint32_t i = end; i < count; i++)
        if (same_direction(&contacts[first], &contacts[i]) > nook_physics_tuning.contact_same_face)
            swap(contacts, end++, i);
    return end;
}

/* ---- corners of one face ---- */

static double along(const dContactGeom *contact, const double direction[3])
{
    return nook_vector_dot(contact->pos, direction);
}

static uint32_t farthest_along(const dContactGeom *face, uint32_t first, uint32_t count, const double direction[3])
{
    uint32_t best = first;
    for (uint32_t i = first + 1; i < count; i++)
        if (along(&face[i], direction) > along(&face[best], direction))
            best = i;
    return best;
}

static uint32_t farthest_from(const dContactGeom *face, uint32_t first, uint32_t count, const double from[3])
{
    uint32_t best = first;
    double best_way = -1.0;
    for (uint32_t i = first; i < count; i++) {
        double way[3];
        nook_vector_add_scaled(face[i].pos, -1.0, from, way);
        if (nook_vector_dot(way, way) > best_way)
            best = i, best_way = nook_vector_dot(way, way);
    }
    return best;
}

/* Whether face[i] stands apart from the corners before `count`. */
static bool apart(const dContactGeom *face, uint32_t i, uint32_t count)
{
    for (uint32_t j = 0; j < count; j++) {
        double way[3];
        nook_vector_add_scaled(face[i].pos, -1.0, face[j].pos, way);
        if (nook_vector_length(way) < nook_physics_tuning.contact_merge)
            return false;
    }
    return true;
}

/* Four corners of a face first: from one end to the other, and to both sides of that line. @return how many stand apart */
static uint32_t pick_corners(dContactGeom *face, uint32_t count)
{
    const double start[3] = { 0.5773, 0.2113, 0.7886 }; /* any: it must only be the same in every step */
    double across[3], along_face[3];
    swap(face, 0, farthest_along(face, 0, count, start));
    uint32_t corners = 1;
    if (count > 1)
        swap(face, 1, farthest_from(face, 1, count, face[0].pos));
    if (count > 1 && apart(face, 1, 1))
        corners = 2;
    if (count <= corners || corners < 2)
        return corners;
    nook_vector_add_scaled(face[1].pos, -1.0, face[0].pos, along_face);
    nook_vector_cross(face[0].normal, along_face, across);
    for (int side = 0; side < 2 && corners < count; side++) {
        uint32_t i = farthest_along(face, corners, count, across);
        if (apart(face, i, corners))
            swap(face, corners++, i);
        for (int k = 0; k < 3; k++)
            across[k] = -across[k];
    }
    return corners;
}

/* The deepest stays too when it lies deeper than all corners: it carries most. @return how many */
static uint32_t reduce_face(dContactGeom *face, uint32_t count)
{
    if (count <= 1)
        return count;
    uint32_t corners = pick_corners(face, count);
    uint32_t deep = deepest(face, 0, count);
    if (deep >= corners && apart(face, deep, corners))
        swap(face, corners++, deep);
    else if (deep >= corners && corners == 1)
        swap(face, 0, deep);
    return corners;
}

uint32_t nook_physics_merge_contacts(dContactGeom *contacts, uint32_t count)
{
    count = drop_broken(contacts, count);
    uint32_t kept = 0, done = 0;
    for (int faces = 0; faces < FACES_MAX && done < count; faces++) {
        swap(contacts, done, deepest(contacts, done, count));
        uint32_t end = gather_face(contacts, done, count);
        uint32_t corners = reduce_face(contacts + done, end - done);
        for (uint32_t i = 0; i < corners; i++)
            contacts[kept++] = contacts[done + i];
        done = end;
    }
    return kept;
}
