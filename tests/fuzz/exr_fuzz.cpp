#include <ImfHeader.h>
#include <ImfRgbaFile.h>
#include <ImfTiledRgbaFile.h>

#include <unistd.h>
#include <filesystem>

#include "engine/asset/image_io.h"
#include "engine/platform/files.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/image_seeds.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto image = vellus::asset::decode_exr({reinterpret_cast<const std::byte*>(data), size});
    vellus::fuzz::require(image ? vellus::fuzz::usable(*image) : !image.error().remedy.empty());
    return 0;
}

namespace {

const std::vector<Imf::Rgba> kPixels(size_t{20} * 12, Imf::Rgba(0.5f, 2.0f, 8.0f, 1.0f));

void add_file(std::vector<vellus::fuzz::Bytes>& seeds, const std::filesystem::path& path) {
    seeds.push_back(vellus::fuzz::to_seed(*vellus::read_file(path)));
    std::filesystem::remove(path);
}

}  // namespace

std::vector<vellus::fuzz::Bytes> vellus::fuzz::fuzz_seeds() {
    std::vector<Bytes> seeds = {to_seed(*asset::encode_exr(small_image_f()))};
    const auto path = std::filesystem::temp_directory_path() /
                      ("vellus_seed_" + std::to_string(getpid()) + ".exr");
    for (const Imf::Compression compression :
         {Imf::RLE_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44A_COMPRESSION,
          Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
        Imf::Header header(20, 12);
        header.compression() = compression;
        {
            Imf::RgbaOutputFile file(path.c_str(), header, Imf::WRITE_RGBA);
            file.setFrameBuffer(kPixels.data(), 1, 20);
            file.writePixels(12);
        }
        add_file(seeds, path);
    }
    {
        Imf::RgbaOutputFile file(path.c_str(), Imf::Header(20, 12), Imf::WRITE_YC);
        file.setFrameBuffer(kPixels.data(), 1, 20);
        file.writePixels(12);
    }
    add_file(seeds, path);
    {
        Imf::TiledRgbaOutputFile file(path.c_str(), 20, 12, 8, 8, Imf::MIPMAP_LEVELS);
        file.setFrameBuffer(kPixels.data(), 1, 20);
        for (int level = 0; level < file.numLevels(); ++level) {
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
    }
    add_file(seeds, path);
    return seeds;
}
