// The invocation's number in CommandBuffer::dispatch_threads, which wraps more than 65,535 groups into rows.
// GLSL only.
#ifndef VELLUS_COMMON_THREAD_GLSL
#define VELLUS_COMMON_THREAD_GLSL

uint thread_index() {
    return gl_GlobalInvocationID.x +
           gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x);
}

#endif
