#pragma once
// How much of a point's sky a box takes: the integral of cosine / pi over the directions that meet it. It is the area of the box's outline,
// projected to the unit disc of the point's plane, over pi. An edge above the plane sweeps angle * cosine of its plane over 2 pi
// (Lambert); what is below the plane shrinks to the disc's rim, where an edge sweeps its azimuth.

// What the arc from a to b sweeps, over 2 pi. Vectors from the point, z along its normal, of any length. Angle / (2 pi sine) by a rational
// function of the cosine, which is within 1e-5 of it (Heitz, Dupuy, Hill, Neubelt 2016, Real-time polygonal-light shading with linearly
// transformed cosines, its code).
float arc_sweeps(vec3 a, vec3 b)
{
    float scale = inversesqrt(max(dot(a, a) * dot(b, b), 1e-30)), cosine = dot(a, b) * scale, y = abs(cosine);
    float ratio = (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.4175940 + (4.1616724 + y) * y);
    vec3 across = cross(a, b) * scale; // as long as the sine: 1 - y^2 would lose it for arcs of nearly half a turn
    if (cosine < 0.0)
        ratio = 0.5 * inversesqrt(max(dot(across, across), 1e-30)) - ratio;
    return across.z * ratio;
}

float edge_sweeps(vec3 a, vec3 b)
{
    vec3 cut = vec3(mix(a.xy, b.xy, a.z / (a.z - b.z)), 0.0), on_rim_a = vec3(a.xy, 0.0), on_rim_b = vec3(b.xy, 0.0);
    bool low = a.z < 0.0, next_low = b.z < 0.0;
    float sum = 0.0;
    if (!(low && next_low))
        sum += arc_sweeps(low ? cut : a, next_low ? cut : b);
    if (low || next_low)
        sum += arc_sweeps(low ? on_rim_a : cut, next_low ? on_rim_b : cut);
    return sum;
}

// Along x: which edges lie between a face that is seen and one that is not. Seen: the low and the high face along y, and along z.
// Bit 2 j + k: the edge of face j along y and face k along z.
uint outline_edges(bvec2 y, bvec2 z)
{
    return uint(y.x != z.x) | uint(y.x != z.y) << 1 | uint(y.y != z.x) << 2 | uint(y.y != z.y) << 3;
}

// The axes in the order in which `axis` is the first.
vec3 rotated(vec3 v, int axis)
{
    return axis == 0 ? v : axis == 1 ? v.yzx : v.zxy;
}

vec3 one_of(mat3 axes, int axis)
{
    return axis == 0 ? axes[0] : axis == 1 ? axes[1] : axes[2];
}

// What the edge does to the sum: bits of outline_edges() in axis 0, 1, 2.
float edge_share(int edge, vec3 low, vec3 high, mat3 axes)
{
    int axis = edge >> 2;
    bool far_y = (edge & 2) != 0, far_z = (edge & 1) != 0;
    low = rotated(low, axis), high = rotated(high, axis);
    float turn = float(far_z ? high.z < 0.0 : low.z > 0.0) - float(far_y ? high.y < 0.0 : low.y > 0.0);
    vec3 x = one_of(axes, axis), y = one_of(axes, axis == 2 ? 0 : axis + 1), z = one_of(axes, axis == 0 ? 2 : axis - 1);
    vec3 beside = y * (far_y ? high.y : low.y) + z * (far_z ? high.z : low.z);
    return turn != 0.0 ? (far_y == far_z ? turn : -turn) * edge_sweeps(beside + x * low.x, beside + x * high.x) : 0.0;
}

// Corners from the point, in units of the box; axes: what those units are. The point is not inside. The outline is gone along edge by edge:
// four or six of twelve, and a software driver compiles them once.
float box_weight(vec3 low, vec3 high, mat3 axes)
{
    bvec3 low_seen = greaterThan(low, vec3(0.0)), high_seen = lessThan(high, vec3(0.0));
    bvec2 x = bvec2(low_seen.x, high_seen.x), y = bvec2(low_seen.y, high_seen.y), z = bvec2(low_seen.z, high_seen.z);
    uint outline = outline_edges(y, z) | outline_edges(z, x) << 4 | outline_edges(x, y) << 8;
    float sum = 0.0;
    do { // there are edges but for what is not a number, which has no share
        sum += edge_share(findLSB(outline), low, high, axes);
        outline &= outline - 1u;
    } while (outline != 0u);
    // An outline around the point straight below runs around the whole rim once more, the other way.
    float weight = sum * sign(determinant(axes));
    return weight < -1e-3 ? weight + 1.0 : weight;
}
