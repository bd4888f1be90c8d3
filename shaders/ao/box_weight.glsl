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

// Corners from the point, in units of the box; axes: what those units are. The point is not inside.
float box_weight(vec3 low, vec3 high, mat3 axes)
{
    vec3 low_seen = vec3(greaterThan(low, vec3(0.0))), high_seen = vec3(lessThan(high, vec3(0.0))); // 1: that face is seen
    float sum = 0.0;
    for (int i = 0; i < 3; i++) { // edges along each axis; those between a face that is seen and one that is not are the outline
        int j = (i + 1) % 3, k = (i + 2) % 3;
        vec3 begin = axes[i] * low[i], end = axes[i] * high[i];
        vec3 low_j = axes[j] * low[j], high_j = axes[j] * high[j], low_k = axes[k] * low[k], high_k = axes[k] * high[k];
        vec4 turn = vec4(low_seen[k] - low_seen[j], low_seen[j] - high_seen[k], high_seen[j] - low_seen[k], high_seen[k] - high_seen[j]);
        if (turn.x != 0.0)
            sum += turn.x * edge_sweeps(low_j + low_k + begin, low_j + low_k + end);
        if (turn.y != 0.0)
            sum += turn.y * edge_sweeps(low_j + high_k + begin, low_j + high_k + end);
        if (turn.z != 0.0)
            sum += turn.z * edge_sweeps(high_j + low_k + begin, high_j + low_k + end);
        if (turn.w != 0.0)
            sum += turn.w * edge_sweeps(high_j + high_k + begin, high_j + high_k + end);
    }
    // An outline around the point straight below runs around the whole rim once more, the other way.
    float weight = sum * sign(determinant(axes));
    return weight < -1e-3 ? weight + 1.0 : weight;
}
