#include "engine/core/log.h"
#include "engine/gpu/program_layout_internal.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_CAPACITY = 512, NAME_CAPACITY = 256 };

/* Lines under construction. */
typedef struct lines {
    const nook_gl *gl;
    GLuint program;
    char *text; /* NULL from the first time that memory is missing */
    size_t size, capacity;
    uint32_t locations;
} lines;

NOOK_PRINTF(2, 3) static void add(lines *self, const char *format, ...)
{
    char line[LINE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    size_t size = strlen(line);
    if (self->text && self->size + size + 1 > self->capacity) {
        size_t capacity = 2 * (self->size + size + 1);
        char *text = realloc(self->text, capacity);
        if (!text)
            free(self->text);
        self->text = text;
        self->capacity = capacity;
    }
    if (!self->text)
        return;
    memcpy(self->text + self->size, line, size + 1);
    self->size += size;
}

/* ---- reading ------------------------------------------------------------------------------------------------------- */

typedef enum type_kind { KIND_VALUE, KIND_SAMPLER, KIND_IMAGE } type_kind;

/* Types that shaders of Nook have or are likely to get; others are told by number, as values. */
static const struct {
    const char *name;
    GLenum type;
    type_kind kind;
} types[] = {
    { "float", GL_FLOAT, KIND_VALUE },
    { "vec2", GL_FLOAT_VEC2, KIND_VALUE },
    { "vec3", GL_FLOAT_VEC3, KIND_VALUE },
    { "vec4", GL_FLOAT_VEC4, KIND_VALUE },
    { "int", GL_INT, KIND_VALUE },
    { "ivec2", GL_INT_VEC2, KIND_VALUE },
    { "ivec3", GL_INT_VEC3, KIND_VALUE },
    { "ivec4", GL_INT_VEC4, KIND_VALUE },
    { "uint", GL_UNSIGNED_INT, KIND_VALUE },
    { "uvec2", GL_UNSIGNED_INT_VEC2, KIND_VALUE },
    { "uvec3", GL_UNSIGNED_INT_VEC3, KIND_VALUE },
    { "uvec4", GL_UNSIGNED_INT_VEC4, KIND_VALUE },
    { "bool", GL_BOOL, KIND_VALUE },
    { "mat2", GL_FLOAT_MAT2, KIND_VALUE },
    { "mat3", GL_FLOAT_MAT3, KIND_VALUE },
    { "mat4", GL_FLOAT_MAT4, KIND_VALUE },
    { "mat3x4", GL_FLOAT_MAT3x4, KIND_VALUE },
    { "mat4x3", GL_FLOAT_MAT4x3, KIND_VALUE },
    { "sampler2D", GL_SAMPLER_2D, KIND_SAMPLER },
    { "sampler3D", GL_SAMPLER_3D, KIND_SAMPLER },
    { "samplerCube", GL_SAMPLER_CUBE, KIND_SAMPLER },
    { "sampler2DShadow", GL_SAMPLER_2D_SHADOW, KIND_SAMPLER },
    { "sampler2DArray", GL_SAMPLER_2D_ARRAY, KIND_SAMPLER },
    { "samplerBuffer", GL_SAMPLER_BUFFER, KIND_SAMPLER },
    { "isampler2D", GL_INT_SAMPLER_2D, KIND_SAMPLER },
    { "isampler3D", GL_INT_SAMPLER_3D, KIND_SAMPLER },
    { "usampler2D", GL_UNSIGNED_INT_SAMPLER_2D, KIND_SAMPLER },
    { "usampler3D", GL_UNSIGNED_INT_SAMPLER_3D, KIND_SAMPLER },
    { "usamplerBuffer", GL_UNSIGNED_INT_SAMPLER_BUFFER, KIND_SAMPLER },
    { "image2D", GL_IMAGE_2D, KIND_IMAGE },
    { "image3D", GL_IMAGE_3D, KIND_IMAGE },
    { "iimage2D", GL_INT_IMAGE_2D, KIND_IMAGE },
    { "iimage3D", GL_INT_IMAGE_3D, KIND_IMAGE },
    { "uimage2D", GL_UNSIGNED_INT_IMAGE_2D, KIND_IMAGE },
    { "uimage3D", GL_UNSIGNED_INT_IMAGE_3D, KIND_IMAGE },
};

/* "vec4", "vec4[3]" */
static type_kind name_type(GLenum type, GLint array_size, char out[NAME_CAPACITY])
{
    char array[24] = "";
    if (array_size > 1)
        snprintf(array, sizeof array, "[%d]", array_size);
    for (size_t i = 0; i < NOOK_COUNT(types); i++) {
        if (types[i].type == type) {
            snprintf(out, NAME_CAPACITY, "%s%s", types[i].name, array);
            return types[i].kind;
        }
    }
    snprintf(out, NAME_CAPACITY, "type_%x%s", type, array);
    return KIND_VALUE;
}

static GLint property(const lines *self, GLenum interface, GLuint index, GLenum name)
{
    GLint value = -1;
    self->gl->GetProgramResourceiv(self->program, interface, index, 1, &name, 1, NULL, &value);
    return value;
}

static void add_member(lines *self, GLenum interface, GLuint index, GLint block, const char *name, const char *type)
{
    bool uniform = interface == GL_UNIFORM;
    GLint binding =
        property(self, uniform ? GL_UNIFORM_BLOCK : GL_SHADER_STORAGE_BLOCK, (GLuint)block, GL_BUFFER_BINDING);
    const char *dot = strchr(name, '.');
    add(self, "%s=%d %s %s at %d\n", uniform ? "uniform" : "storage", binding, dot ? dot + 1 : name, type,
        property(self, interface, index, GL_OFFSET));
}

/* A uniform that lies in no block. */
static void add_loose(lines *self, GLuint index, const char *type, type_kind kind)
{
    GLint location = property(self, GL_UNIFORM, index, GL_LOCATION), unit = 0;
    if (location < 0)
        return;
    if (location < PROGRAM_LOCATIONS)
        self->locations |= 1u << location;
    if (kind == KIND_VALUE) {
        add(self, "location=%d %s\n", location, type);
    } else {
        self->gl->GetUniformiv(self->program, location, &unit);
        add(self, "%s=%d %s\n", kind == KIND_IMAGE ? "image" : "texture", unit, type);
    }
}

static void read_interface(lines *self, GLenum interface)
{
    GLint count = 0;
    self->gl->GetProgramInterfaceiv(self->program, interface, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        char name[NAME_CAPACITY] = "", type[NAME_CAPACITY];
        self->gl->GetProgramResourceName(self->program, interface, i, sizeof name, NULL, name);
        type_kind kind =
            name_type((GLenum)property(self, interface, i, GL_TYPE), property(self, interface, i, GL_ARRAY_SIZE), type);
        GLint block = interface == GL_PROGRAM_OUTPUT ? -1 : property(self, interface, i, GL_BLOCK_INDEX);
        GLint output = interface == GL_PROGRAM_OUTPUT ? property(self, interface, i, GL_LOCATION) : -1;
        if (output >= 0)
            add(self, "output=%d %s\n", output, type);
        else if (block >= 0)
            add_member(self, interface, i, block, name, type);
        else if (interface == GL_UNIFORM)
            add_loose(self, i, type, kind);
    }
}

char *nook_program_layout_read(const nook_gl *gl, GLuint program, bool computes, uint32_t *out_locations)
{
    lines self = { .gl = gl, .program = program, .text = calloc(1, LINE_CAPACITY), .capacity = LINE_CAPACITY };
    GLint local_size[3] = { 0 };
    if (computes) {
        gl->GetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, local_size);
        add(&self, "local_size %d %d %d\n", local_size[0], local_size[1], local_size[2]);
    }
    read_interface(&self, GL_UNIFORM);
    read_interface(&self, GL_BUFFER_VARIABLE);
    read_interface(&self, GL_PROGRAM_OUTPUT);
    *out_locations = self.locations;
    return self.text;
}
