#include "engine/platform/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace vellus {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string errno_text() {
    return std::generic_category().message(errno);
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) {
        return Error{"no such file", path.string(), "check the path"};
    }
    if (!std::filesystem::is_regular_file(status)) {
        return Error{"not a regular file", path.string(), "give a file"};
    }
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) return Error{"cannot open: " + errno_text(), path.string(), "check permissions"};

    std::vector<std::byte> bytes(std::filesystem::file_size(path, code));
    if (code) return Error{"cannot tell its size: " + code.message(), path.string(), ""};
    const size_t read = bytes.empty() ? 0 : std::fread(bytes.data(), 1, bytes.size(), file.get());
    if (read != bytes.size()) {
        return Error{fmt::format("read {} of {} bytes", read, bytes.size()), path.string(),
                     "did another program change it?"};
    }
    return bytes;
}

Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::error_code code;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), code);
    std::filesystem::path temporary = path;
    temporary += fmt::format(".tmp{}", ::getpid());

    File file(std::fopen(temporary.c_str(), "wb"));
    if (!file) {
        return Error{"cannot write: " + errno_text(), path.string(),
                     "check that the folder exists and is writable"};
    }
    const bool written =
        bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    const bool closed = std::fclose(file.release()) == 0;
    if (!written || !closed) {
        const std::string reason = errno_text();
        std::filesystem::remove(temporary, code);
        return Error{"cannot write: " + reason, path.string(), "is the disk full?"};
    }
    std::filesystem::rename(temporary, path, code);
    if (code) {
        const std::string reason = code.message();
        std::filesystem::remove(temporary, code);
        return Error{"cannot rename into place: " + reason, path.string(), ""};
    }
    return {};
}

Result<void> write_file(const std::filesystem::path& path, std::string_view text) {
    return write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace vellus
