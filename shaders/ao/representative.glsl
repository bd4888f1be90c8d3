#pragma once
// Which surface a pixel of the trace stands for, by vote: of four pixels of its block the one that most of them agree with by plane and
// normal. What is a pixel or two wide (a joint, a moulding's bevel, a wire) is then left to the upscaling all along instead of being
// met by every fourth pixel, which draws dashes of it.
#include "ao/host.glsl"

const int VOTERS = 4;

struct Voter {
    vec3 position, normal; // view space; position 0: nothing seen
};

Voter voter_at(ivec2 pixel)
{
    ivec2 p = min(pixel, frame.full_size - 1);
    float depth = distance_at(p);
    return Voter(full_ray(vec2(p)) * depth, normal_at(p, depth));
}

// Where in its block voter i stands. Of 4 x 4 pixels no two in a row or a column: in Gray's order, the rows one ahead.
ivec2 place_in_block(int i)
{
    int row = (i + 1) & 3;
    return frame.scale == 2 ? ivec2(i & 1, i >> 1) : ivec2(i ^ i >> 1, row ^ row >> 1);
}

// How far b lies on a's surface, 0 to 1: by the distance to a's plane in pixels of the trace, and by the normals.
float agreement(Voter a, Voter b)
{
    float plane = dot(a.normal, b.position - a.position) / (-a.position.z * pixel_footprint() * float(frame.scale));
    float facing = max(dot(a.normal, b.normal), 0.0);
    facing *= facing;
    facing *= facing;
    return b.position.z < 0.0 ? facing * facing / (1.0 + plane * plane) : 0.0;
}

// Where the winner's plane is seen through the middle of the block, from where rays start. A plane seen from its edge would be met
// anywhere: no farther from the winner than on one seen under 14 degrees a block away; nor behind what the middle itself sees, if that
// is near: a strip's plane goes on into the wall beside it.
float depth_of_plane(Voter winner, vec3 ray, float seen)
{
    float own = -winner.position.z, reach = 4.0 * own * pixel_footprint() * float(frame.scale);
    float met = dot(winner.normal, winner.position) / dot(winner.normal, ray);
    float far = seen > max(own - reach, 0.0) ? min(seen, own + reach) : own + reach;
    return met > 0.0 ? clamp(met, own - reach, far) : own; // not for NaN
}

// Not by voters[i]: what is indexed by a loop lies in memory, and a software driver writes there lane by lane.
void set_voter(inout Voter voters[VOTERS], int i, Voter voter)
{
    for (int k = 0; k < VOTERS; k++) {
        if (k == i)
            voters[k] = voter;
    }
}

Voter get_voter(Voter voters[VOTERS], int i)
{
    Voter found = voters[0];
    for (int k = 1; k < VOTERS; k++) {
        if (k == i)
            found = voters[k];
    }
    return found;
}

// @return depth, 0 where nothing is seen
float representative(ivec2 trace_pixel, out vec3 normal)
{
    const Voter nobody = Voter(vec3(0.0), vec3(0.0, 0.0, 1.0));
    int count = frame.scale > 1 ? VOTERS : 0; // unknown to compilers: voters written out take a software driver a fifth of a second
    Voter voters[VOTERS] = Voter[](nobody, nobody, nobody, nobody), winner = nobody;
    for (int i = 0; i < count; i++)
        set_voter(voters, i, voter_at(trace_pixel * frame.scale + place_in_block(i)));
    float most = -1.0;
    for (int i = 0; i < count; i++) {
        Voter own = get_voter(voters, i);
        float votes = 0.0;
        for (int j = 0; j < VOTERS; j++)
            votes += j == i ? 0.0 : agreement(own, voters[j]);
        if (own.position.z < 0.0 && votes > most) {
            winner = own;
            most = votes;
        }
    }
    normal = winner.normal;
    ivec2 middle = full_pixel(trace_pixel);
    return most >= 0.0 ? depth_of_plane(winner, full_ray(vec2(middle)), distance_at(middle)) : 0.0;
}
