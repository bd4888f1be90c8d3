// The sky: radiance runs from bottom to top with the sine of elevation, L(w) = mean + slope * w.y. Needs lights.glsl.
#pragma once

vec3 sky_radiance(vec3 direction)
{
    return mix(lights.ambient_bottom.rgb, lights.ambient_top.rgb, 0.5 + 0.5 * direction.y);
}

// Irradiance / pi of a surface: the cosine-weighted mean of that sky. A linear L keeps its mean and two thirds of its slope.
vec3 sky_diffuse(vec3 normal)
{
    return mix(lights.ambient_bottom.rgb, lights.ambient_top.rgb, 0.5 + normal.y / 3.0);
}

// The mean over a glossy lobe: between a mirror's and Lambert's.
vec3 sky_specular(vec3 reflected, float roughness)
{
    return mix(lights.ambient_bottom.rgb, lights.ambient_top.rgb, 0.5 + reflected.y * mix(0.5, 1.0 / 3.0, roughness));
}
