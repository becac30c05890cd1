// What libFuzzer does, without coverage: a main() for any LLVMFuzzerTestOneInput, so that a fuzz
// target also builds with GCC and runs in CI for a fixed number of inputs.
//
//   fuzz_xyz CORPUS... [--runs N] [--seed S] [--max-len BYTES] [--seconds-per-input N]
//
// CORPUS are files or folders. Every file is replayed, then N mutants of them are made and tried:
// the same seed, corpus and number give the same inputs. An input that ends the process, or that
// takes longer than --seconds-per-input (10), is left in ./crash-SEED-RUN, which replays it.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

struct Options {
  std::vector<std::filesystem::path> corpus;
  std::uint64_t runs = 0, seed = 1;
  std::size_t max_length = 4096;
  unsigned seconds_per_input = 10;
};

[[noreturn]] void usage(const char* program) {
  std::fprintf(stderr,
               "usage: %s CORPUS... [--runs N] [--seed S] [--max-len BYTES] "
               "[--seconds-per-input N]\n",
               program);
  std::exit(2);
}

Options read_options(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (!word.starts_with("--")) {
      options.corpus.emplace_back(word);
      continue;
    }
    char* end = nullptr;
    if (i + 1 == count) usage(words[0]);
    const std::uint64_t value = std::strtoull(words[++i], &end, 10);
    if (end == words[i] || *end != '\0') usage(words[0]);
    if (word == "--runs") {
      options.runs = value;
    } else if (word == "--seed") {
      options.seed = value;
    } else if (word == "--max-len") {
      options.max_length = std::max<std::size_t>(value, 1);
    } else if (word == "--seconds-per-input") {
      options.seconds_per_input = unsigned(value);
    } else {
      usage(words[0]);
    }
  }
  if (options.corpus.empty()) usage(words[0]);
  return options;
}

Input read_input(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// In the order of the paths, so that mutants do not depend on the file system.
std::vector<std::filesystem::path> files_of(const std::vector<std::filesystem::path>& corpus) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : corpus) {
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Makes mutants as libFuzzer and AFL do, without knowing what they reach.
class Mutator {
 public:
  Mutator(std::vector<Input> corpus, const Options& options)
      : corpus_(std::move(corpus)), max_length_(options.max_length), random_(options.seed) {}

  Input next() {
    Input input = corpus_[below(corpus_.size())];
    const std::size_t changes = 1 + below(5);
    for (std::size_t i = 0; i < changes; ++i) change(input);
    if (input.size() > max_length_) input.resize(max_length_);
    return input;
  }

 private:
  /// Not std::uniform_int_distribution, whose numbers depend on the library.
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : std::size_t(random_() % limit); }
  std::size_t place_in(const Input& input) { return below(input.size()); }
  std::ptrdiff_t gap_in(const Input& input) { return std::ptrdiff_t(below(input.size() + 1)); }

  void change(Input& input) {
    if (input.empty()) input.push_back(std::uint8_t(random_()));
    switch (below(9)) {
      case 0:
        input[place_in(input)] ^= std::uint8_t(1u << below(8));
        break;
      case 1:
        input[place_in(input)] = std::uint8_t(random_());
        break;
      case 2:
        put_number(input);
        break;
      case 3:
        replace_digit(input);
        break;
      case 4:
        erase_part(input);
        break;
      case 5:
        repeat_part(input);
        break;
      case 6:
        splice(input);
        break;
      case 7:
        input.insert(input.begin() + gap_in(input), kMarks[below(std::size(kMarks))]);
        break;
      default:
        insert_word(input);
    }
  }

  /// A number that is on some edge, in one to eight bytes of either order.
  void put_number(Input& input) {
    static constexpr std::uint64_t kEdges[] = {
        0,          1,          2,          0x7F,       0x80,
        0xFF,       0x7FFF,     0x8000,     0xFFFF,     0x7FFFFFFF,
        0x80000000, 0xFFFFFFFF, 0x7F800000, 0x7FC00000, 0xFFFFFFFFFFFFFFFF};
    const std::uint64_t value = kEdges[below(std::size(kEdges))] + below(3) - 1;
    const std::size_t width = std::size_t(1) << below(4);
    const bool big = below(2) == 1;
    const std::size_t start = place_in(input);
    for (std::size_t i = 0; i < width && start + i < input.size(); ++i) {
      input[start + i] = std::uint8_t(value >> (8 * (big ? width - 1 - i : i)));
    }
  }

  /// Most formats here are text: their counts and indices are digits.
  void replace_digit(Input& input) {
    const std::size_t start = place_in(input);
    for (std::size_t i = 0; i < input.size(); ++i) {
      std::uint8_t& byte = input[(start + i) % input.size()];
      if (byte < '0' || byte > '9') continue;
      byte = std::uint8_t('0' + below(10));
      return;
    }
  }

  void erase_part(Input& input) {
    const std::size_t start = place_in(input);
    const std::size_t length = 1 + below(std::min<std::size_t>(input.size() - start, 64));
    const auto first = input.begin() + std::ptrdiff_t(start);
    input.erase(first, first + std::ptrdiff_t(std::min(length, input.size() - start)));
  }

  void repeat_part(Input& input) {
    const std::size_t start = place_in(input);
    const std::size_t length = 1 + below(std::min<std::size_t>(input.size() - start, 64));
    const std::size_t last = std::min(start + length, input.size());
    const Input part(input.begin() + std::ptrdiff_t(start), input.begin() + std::ptrdiff_t(last));
    const std::size_t times = below(8) == 0 ? 200 : 1;
    for (std::size_t i = 0; i < times && input.size() < max_length_; ++i) {
      input.insert(input.begin() + std::ptrdiff_t(start), part.begin(), part.end());
    }
  }

  /// The start of this input, and the end of another one.
  void splice(Input& input) {
    const Input& other = corpus_[below(corpus_.size())];
    input.resize(std::size_t(gap_in(input)));
    input.insert(input.end(), other.begin() + gap_in(other), other.end());
  }

  void insert_word(Input& input) {
    static constexpr const char* kWords[] = {"-1",   "1e300", "nan", "inf", "4294967296",
                                             "null", "[]",    "{}",  "\n",  " ",
                                             "\"\"", "0x7f",  "&a",  "*a"};
    const std::string word = kWords[below(std::size(kWords))];
    input.insert(input.begin() + gap_in(input), word.begin(), word.end());
  }

  static constexpr std::uint8_t kMarks[] = {'{',  '}', '[', ']', ',', ':', '"', '\\', '\n',
                                            '\r', ' ', '-', '.', 'e', '0', '#', 0,    0xFF};

  std::vector<Input> corpus_;
  std::size_t max_length_;
  std::mt19937_64 random_;
};

// What the signal handler writes.
const Input* current_input = nullptr;
char crash_name[64] = "";

extern "C" void keep_input(int signal_number) {
  static const char text[] = "the input that did it is left in ";
  if (current_input != nullptr) {
    const int file = open(crash_name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && write(file, current_input->data(), current_input->size()) >= 0) {
      ssize_t ignored = write(2, text, sizeof(text) - 1);
      ignored = write(2, crash_name, std::strlen(crash_name));
      ignored = write(2, "\n", 1);
      static_cast<void>(ignored);
    }
    current_input = nullptr;
  }
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

void run(const Input& input, const Options& options, const std::string& number) {
  std::snprintf(crash_name, sizeof(crash_name), "crash-%llu-%s",
                static_cast<unsigned long long>(options.seed), number.c_str());
  current_input = &input;
  alarm(options.seconds_per_input);
  LLVMFuzzerTestOneInput(input.data(), input.size());
  alarm(0);
  current_input = nullptr;
}

}  // namespace

int main(int count, char** words) {
  const Options options = read_options(count, words);
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM}) {
    std::signal(number, keep_input);
  }
  std::vector<Input> corpus;
  for (const std::filesystem::path& file : files_of(options.corpus)) {
    corpus.push_back(read_input(file));
    run(corpus.back(), options, "file" + std::to_string(corpus.size()));
  }
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no file in the corpus\n", words[0]);
    return 2;
  }
  const std::size_t files = corpus.size();
  Mutator mutator(std::move(corpus), options);
  for (std::uint64_t i = 0; i < options.runs; ++i) {
    run(mutator.next(), options, std::to_string(i));
  }
  std::printf("%zu files replayed, %llu mutants tried (seed %llu): no finding\n", files,
              static_cast<unsigned long long>(options.runs),
              static_cast<unsigned long long>(options.seed));
  return 0;
}
