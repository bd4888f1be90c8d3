#pragma once
// What ao.reuse and ao.accumulate know of a value, in 16 bits: the age by which it comes in its turn (4), the frames since it was traced, which are no
// more (4), and how many traces it is the mean of (8).

uint ages_packed(uint age, uint since, uint mean_of)
{
    return age | since << 4 | mean_of << 8;
}

uint age_of(uint ages)
{
    return ages & 15u;
}

uint since_of(uint ages)
{
    return ages >> 4 & 15u;
}

uint mean_of(uint ages)
{
    return ages >> 8;
}
