/**
 * falloff.h - rho(d): how much a hit at distance d occludes (docs/techniques.md, equation 1).
 *
 * rho(0) = 1 and rho(d >= r_max) = 0 for every choice. The same formulas in GLSL: shaders/ao/falloff.glsl; a test holds
 * the two together.
 */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/** The choices of ao.falloff, in the order of modules/ao/params.def. */
typedef enum nook_falloff {
    NOOK_FALLOFF_HARD,       /**< 1 */
    NOOK_FALLOFF_LINEAR,     /**< 1 - k, k = d / r_max */
    NOOK_FALLOFF_QUADRATIC,  /**< 1 - k^2 */
    NOOK_FALLOFF_WENDLAND,   /**< (1 - k)^4 (4 k + 1): Reinbothe et al. 2009 */
    NOOK_FALLOFF_EXPONENTIAL /**< exp(-tau k), cut at k = 1: Iones et al.'s map, turned from openness to occlusion */
} nook_falloff;

/**
 * @param distance  metres, >= 0; r_max > 0
 * @param tau       decay over r_max; exponential only
 * @return [0, 1]; 0 for a distance that is not a number
 */
double nook_falloff_evaluate(nook_falloff falloff, double distance, double r_max, double tau);

#ifdef __cplusplus
}
#endif
