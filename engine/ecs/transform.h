#pragma once

/** Where an entity stands. In double, so that worlds far from the origin hold; see docs/architecture.md, Precision. */
typedef struct nook_transform {
    double world_from_local[16]; /**< Affine, column-major, column vectors; metres. */
} nook_transform;
