/**
 * goal.h - what is asked of a setting, and which of two serves it better.
 */
#pragma once
#include <stdbool.h>

/** At least one of the two is given. */
typedef struct nook_tune_goal {
    double max_error; /**< RMSE of visibility; 0: none. */
    double max_ms;    /**< Milliseconds a frame; 0: none. */
} nook_tune_goal;

/** What a setting does. */
typedef struct nook_tune_cost {
    double error; /**< RMSE of visibility. */
    double ms;
} nook_tune_cost;

bool nook_tune_fits(const nook_tune_goal *goal, const nook_tune_cost *cost);

/** log(a / b), where nothing counts as less than a millionth: an error of 0 is not infinitely better. */
double nook_tune_log_ratio(double a, double b);

/** How far outside of the budget: 0 within it, else the sum of the logarithms of what it exceeds its limits by. */
double nook_tune_excess(const nook_tune_goal *goal, const nook_tune_cost *cost);

/** What is made small among settings that fit: ms under a limit to the error alone, else the error. */
double nook_tune_objective(const nook_tune_goal *goal, const nook_tune_cost *cost);

/** What fits is better than what does not; of two that fit the one with the smaller objective, of two that do not the nearer. */
bool nook_tune_better(const nook_tune_goal *goal, const nook_tune_cost *a, const nook_tune_cost *b);
