#pragma once

// tinygltf as this engine compiles it: every file must see the same switches.
#ifndef TINYGLTF_NO_FS
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#endif
#include <tiny_gltf.h>
