#pragma once
// The pixels of a 4 x 4 tile share the work: each has one of 16 blocks of it, so that the mean over a tile (ao.filter: tile) is
// that of 16 times as many samples. Neighbours get blocks that are far apart in the sequence.
const int BLOCKS = 16;
const int BLOCK[BLOCKS] = int[BLOCKS](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);

int block_of(ivec2 pixel)
{
    return BLOCK[(pixel.y & 3) * 4 + (pixel.x & 3)];
}
