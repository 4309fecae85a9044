#include "files/file_seal.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <span>
#include <string_view>
#include <vector>

#include "files/content_digest.hpp"
#include "files/output_file.hpp"

namespace files {

namespace {

constexpr std::string_view first_line = "fpm checkpoint\n";
constexpr std::size_t longest_writer = 256;

std::string head_of(const FileSeal& seal) {
  return fmt::format("{}schema {}\nwriter {}\nbytes {}\n", first_line, seal.schema, seal.writer,
                     seal.bytes);
}

std::string text_of(const FileSeal& seal) {
  std::string text = head_of(seal) + fmt::format("sum {:016x}\n", seal.sum);
  text.resize(seal_size - 1, ' ');
  return text + '\n';
}

/// The number of a line `name number`, which it takes off `rest`; 0 if it is none.
template <class Number>
Number number_in_line(std::string_view& rest, std::string_view name, int base = 10) {
  Number number = 0;
  const std::string_view line = rest.substr(0, rest.find('\n'));
  if (line.starts_with(name) && line.size() > name.size()) {
    const std::string_view digits = line.substr(name.size() + 1);
    (void)std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
  }
  rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  return number;
}

FileSeal parsed(std::string_view text) {
  FileSeal seal;
  std::string_view rest = text.substr(first_line.size());
  seal.schema = number_in_line<std::int64_t>(rest, "schema");
  constexpr std::string_view writer = "writer ";
  const std::size_t end = rest.find('\n');
  if (rest.starts_with(writer) && end != std::string_view::npos) {
    seal.writer = rest.substr(writer.size(), end - writer.size());
    rest.remove_prefix(end + 1);
  }
  seal.bytes = number_in_line<std::uint64_t>(rest, "bytes");
  seal.sum = number_in_line<std::uint64_t>(rest, "sum", 16);
  return seal;
}

std::string beginning_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(seal_size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

/// The seal that a file would have with this schema and writer.
FileSeal measured(const std::filesystem::path& file, std::int64_t schema,
                  const std::string& writer) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(seal_size));
  constexpr std::size_t piece = std::size_t{1} << 20U;  // a multiple of the words of the sum
  std::vector<char> buffer(piece);
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  FileSeal seal{schema, writer, size > seal_size ? size - seal_size : 0, 0};
  const std::string head = head_of(seal);
  seal.sum = hash_of(std::as_bytes(std::span(head)), 0);
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto got = static_cast<std::size_t>(stream.gcount());
    seal.sum = hash_of(std::as_bytes(std::span(buffer).first(got)), seal.sum);
  }
  if (failure || !stream.eof()) throw FileError(file, "cannot be read");
  return seal;
}

}  // namespace

void write_seal(const std::filesystem::path& file, std::int64_t schema, const std::string& writer,
                const SystemCalls& system) {
  std::string line = writer.substr(0, longest_writer);
  std::ranges::replace(line, '\n', ' ');
  const std::string text = text_of(measured(file, schema, line));
  const int number = system.open(file.c_str(), O_WRONLY, 0);
  if (number < 0) throw system_error(file, "cannot be opened", errno);
  int failure = write_all(system, number, std::as_bytes(std::span(text)), 0);
  if (system.close(number) != 0 && failure == 0) failure = errno;
  if (failure != 0) throw system_error(file, "cannot be written", failure);
}

bool has_seal(const std::filesystem::path& file) {
  return beginning_of(file).starts_with(first_line);
}

std::optional<FileSeal> read_seal(const std::filesystem::path& file) {
  const std::string text = beginning_of(file);
  if (!text.starts_with(first_line)) return std::nullopt;
  const FileSeal seal = parsed(text);
  if (text_of(seal) != text) throw FileError(file, "its seal (the first 512 bytes) is damaged");
  return seal;
}

void require_unbroken(const std::filesystem::path& file, const FileSeal& seal) {
  const FileSeal found = measured(file, seal.schema, seal.writer);
  if (found.bytes != seal.bytes) {
    throw FileError(file, fmt::format("is cut or grown: it holds {} bytes after its seal, not {}",
                                      found.bytes, seal.bytes));
  }
  if (found.sum != seal.sum) {
    throw FileError(file, "is damaged: its bytes are not those that were sealed");
  }
}

}  // namespace files
