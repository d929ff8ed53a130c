#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>

#include "assets/generator/asset_files.h"
#include "engine/platform/files.h"
#include "engine/platform/log.h"

int main(int argc, char** argv) try {
    CLI::App app(
        "Makes the project's own assets: a sculpted bust, its hair, and the default scene.");
    std::filesystem::path folder = VELLUS_ASSET_DIR;
    app.add_option("--out", folder, "folder that takes scenes/ and grooms/")->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    const auto files = vellus::sculpt::make_asset_files();
    if (!files) {
        vellus::log_error("{}", files.error().message());
        return 1;
    }
    for (const vellus::sculpt::AssetFile& file : *files) {
        const auto written = vellus::write_file(folder / file.path, file.bytes);
        if (!written) {
            vellus::log_error("{}", written.error().message());
            return 1;
        }
        vellus::log_info("{}: {} bytes", (folder / file.path).string(), file.bytes.size());
    }
    return 0;
} catch (const std::exception& exception) {
    vellus::log_error("{}", exception.what());
    return 1;
}
