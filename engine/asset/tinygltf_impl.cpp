// The one place where tinygltf is compiled. It gets neither files nor images: gltf_bytes and
// image_io read those.
#include <fstream>  // tinygltf writes files, but includes this only where it also reads them

#define TINYGLTF_IMPLEMENTATION
#include "engine/asset/gltf_tiny.h"
