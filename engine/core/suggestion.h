/**
 * suggestion.h - "did you mean": the name nearest to one that does not exist.
 */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/** Letters to insert, delete or replace to make `a` from `b`; 1000 when either is over 31 bytes. For suggestions. */
int nook_text_distance(const char *a, const char *b);

/** Start with nook_suggestion_for, offer every name that would have been right, then print `nearest`. */
typedef struct nook_suggestion {
    const char *given;   /**< What was asked for. Borrowed. */
    const char *nearest; /**< Of those offered, or NULL: nothing near enough to be a misspelling. Borrowed. */
    int distance;        /**< Letters between the two. */
} nook_suggestion;

nook_suggestion nook_suggestion_for(const char *given);
/** The first of several that are equally near stays. */
void nook_suggestion_offer(nook_suggestion *suggestion, const char *name);

#ifdef __cplusplus
}
#endif
