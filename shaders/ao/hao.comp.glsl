// Technique "hao", hao.slicemaps = one.
#include "ao/hao.glsl"

bool is_full(ivec3 voxel)
{
    return is_full_along_z(voxel);
}
