#pragma once
// The pixels of a 4 x 4 tile share the work: each has one of 16 blocks of it, so that the mean over a tile (ao.filter: tile) is
// that of 16 times as many samples. Neighbours get blocks that are far apart in the sequence: Bayer's 4x4 matrix (1973).
const int BLOCKS = 16;

int block_of(ivec2 pixel) // nook_direction_block() of modules/ao/sampling.h
{
    int odd = pixel.x ^ pixel.y;
    return (odd & 1) << 3 | (pixel.y & 1) << 2 | (odd & 2) | (pixel.y >> 1 & 1);
}
