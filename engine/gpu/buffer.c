#include "engine/core/log.h"
#include "engine/gpu/gpu_internal.h"
#include <assert.h>

nook_result nook_buffer_create(nook_gpu *gpu, const void *data, size_t size, nook_buffer *out_buffer)
{
    const nook_gl *gl = gpu->gl;
    nook_buffer buffer = { .id = 0, .size = size };
    if (size == 0 || size > PTRDIFF_MAX)
        return nook_fail(NOOK_E_RANGE, "buffer: %zu bytes; it must hold at least one", size);
    nook_gpu_take_errors(gpu, "a call before a buffer was made");
    gl->CreateBuffers(1, &buffer.id);
    gl->NamedBufferStorage(buffer.id, (GLsizeiptr)size, data, GL_DYNAMIC_STORAGE_BIT);
    if (gl->GetError() != GL_NO_ERROR) {
        gl->DeleteBuffers(1, &buffer.id);
        return nook_fail(NOOK_E_MEMORY, "buffer: no room for %zu bytes", size);
    }
    *out_buffer = buffer;
    return NOOK_OK;
}

void nook_buffer_destroy(nook_gpu *gpu, nook_buffer *buffer)
{
    if (buffer->id != 0)
        gpu->gl->DeleteBuffers(1, &buffer->id);
    *buffer = (nook_buffer){ 0 };
}

void nook_buffer_update(nook_gpu *gpu, nook_buffer buffer, size_t offset, const void *data, size_t size)
{
    assert(offset <= buffer.size && size <= buffer.size - offset);
    gpu->gl->NamedBufferSubData(buffer.id, (GLintptr)offset, (GLsizeiptr)size, data);
}

void nook_buffer_read(nook_gpu *gpu, nook_buffer buffer, size_t offset, void *out, size_t size)
{
    assert(offset <= buffer.size && size <= buffer.size - offset);
    gpu->gl->GetNamedBufferSubData(buffer.id, (GLintptr)offset, (GLsizeiptr)size, out);
}

void nook_bind_uniform(nook_gpu *gpu, uint32_t unit, nook_buffer buffer)
{
    gpu->gl->BindBufferBase(GL_UNIFORM_BUFFER, unit, buffer.id);
}

void nook_bind_storage(nook_gpu *gpu, uint32_t unit, nook_buffer buffer)
{
    gpu->gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, unit, buffer.id);
}
