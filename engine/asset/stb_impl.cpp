// The one place where stb is compiled: PNG from memory, PNG and HDR to memory. (JPEG is libjpeg's:
// stb 2.27 writes out of bounds on a hostile Huffman table.)
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768
#include <stb_image.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
