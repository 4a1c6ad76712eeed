// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace io {
namespace {

namespace fs = std::filesystem;

base::Problem unwritable(const std::string& path, int reason) {
  return {.where = path + ":",
          .limit = std::string("cannot be written: ") + std::strerror(reason),
          .cure = reason == EISDIR
                      ? "name a file in it"
                      : "check that the folder exists and may be written, and that the disk has room"};
}

/// The name is safe on the disk only once its folder is.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

std::string partial_name(const std::string& path) {
  fs::path name(path);
  const std::string extension = name.extension().string();
  return name.replace_extension(fmt::format(".partial{}", extension)).string();
}

void AtomicFile::Remove::operator()(std::string* name) const {
  if (!name->empty()) ::unlink(name->c_str());
  delete name;
}

base::Result<AtomicFile> AtomicFile::create(const std::string& path) {
  static std::atomic<int> count{0};
  AtomicFile file;
  file.path_ = path;
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return unwritable(path, EISDIR);
  int descriptor = -1;
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    std::error_code ignored;
    // A link keeps its place: what it names is replaced.
    if (exists) file.path_ = fs::canonical(path, ignored).string();
    if (exists && ::access(path.c_str(), W_OK) != 0) return unwritable(path, errno);
    const fs::path target(file.path_);
    const std::string hidden = fmt::format(".{}.tmp{}-{}", target.filename().string(), ::getpid(), count++);
    const fs::path name = target.parent_path() / hidden;
    descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) file.temporary_.reset(new std::string(name.string()));
  }
  if (descriptor < 0) return unwritable(path, errno);
  file.file_.reset(::fdopen(descriptor, "wb"));
  return file;
}

void AtomicFile::write(std::string_view text) {
  if (error_ == 0 && std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) error_ = errno;
}

base::Problems AtomicFile::commit_partial() { return commit_as(temporary_ ? partial_name(path_) : path_); }

base::Problems AtomicFile::commit_as(const std::string& path) {
  if (!file_) return {};
  if (error_ == 0 && std::fflush(file_.get()) != 0) error_ = errno;
  if (error_ == 0 && temporary_ && ::fsync(::fileno(file_.get())) != 0) error_ = errno;
  if (std::fclose(file_.release()) != 0 && error_ == 0) error_ = errno;
  if (!temporary_) return error_ ? base::Problems{unwritable(path, error_)} : base::Problems{};
  if (error_ == 0 && std::rename(temporary_->c_str(), path.c_str()) != 0) error_ = errno;
  if (error_ != 0) return {unwritable(path, error_)};
  temporary_->clear();
  sync_folder(fs::path(path).parent_path());
  return {};
}

}  // namespace io
