/* For cppcheck alone (./nook lint), which does not look into system headers: that these types of cglm's are arrays. */
typedef float vec3[3], vec4[4], mat3[3][3], mat4[4][4];
