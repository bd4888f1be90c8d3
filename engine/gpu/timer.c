#include "engine/gpu/gpu_internal.h"

bool nook_gpu_timer_trusted(const nook_gpu *gpu)
{
    return !gpu->software;
}

void nook_gpu_timer_create(nook_gpu *gpu, nook_gpu_timer *out_timer)
{
    GLuint names[2];
    gpu->gl->CreateQueries(GL_TIMESTAMP, 2, names);
    *out_timer = (nook_gpu_timer){ .begin = names[0], .end = names[1] };
}

void nook_gpu_timer_destroy(nook_gpu *gpu, nook_gpu_timer *timer)
{
    const GLuint names[2] = { timer->begin, timer->end };
    gpu->gl->DeleteQueries(2, names);
    *timer = (nook_gpu_timer){ 0 };
}

void nook_gpu_timer_begin(nook_gpu *gpu, nook_gpu_timer timer)
{
    gpu->gl->QueryCounter(timer.begin, GL_TIMESTAMP);
}

void nook_gpu_timer_end(nook_gpu *gpu, nook_gpu_timer timer)
{
    gpu->gl->QueryCounter(timer.end, GL_TIMESTAMP);
}

double nook_gpu_timer_ms(nook_gpu *gpu, nook_gpu_timer timer)
{
    GLuint64 begin = 0, end = 0;
    gpu->gl->GetQueryObjectui64v(timer.begin, GL_QUERY_RESULT, &begin);
    gpu->gl->GetQueryObjectui64v(timer.end, GL_QUERY_RESULT, &end);
    return (double)(int64_t)(end - begin) * 1e-6;
}
