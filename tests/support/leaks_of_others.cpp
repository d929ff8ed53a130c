#include <dlfcn.h>

#include <initializer_list>

// Linked into tests under AddressSanitizer only. The validation layer (1.3.239) and the software
// driver keep some memory when a device is destroyed, although all our objects are: the layer's own
// object tracker would name those. LeakSanitizer can tell theirs from ours by the library's name,
// which takes that they are still loaded when it looks: RTLD_NODELETE.

extern "C" const char* __lsan_default_suppressions();

extern "C" const char* __lsan_default_suppressions() {
    return "leak:libVkLayer_khronos_validation.so\n"
           "leak:libvulkan_lvp.so\n"
           "leak:libLLVM-\n";
}

namespace {

const bool kept = [] {
    for (const char* library : {"libVkLayer_khronos_validation.so", "libvulkan_lvp.so"}) {
        dlopen(library, RTLD_LAZY | RTLD_NODELETE);
    }
    return true;
}();

}  // namespace
