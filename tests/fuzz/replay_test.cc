// What the fuzzers found once, and some thousand random inputs, for builds without libFuzzer.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "fuzz/markup_mutator.h"
#include "fuzz/targets.h"
#include "support/random.h"
#include "support/urdf_text.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;
using Target = void (*)(const std::uint8_t*, size_t);

void run(Target target, const std::string& bytes) {
  target(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string file_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A find is a file TARGET-anything.
void replay(const std::string& name, Target target) {
  for (const auto& entry : fs::directory_iterator(ARBOC_SOURCE_DIR "/tests/fuzz/finds")) {
    if (!entry.path().filename().string().starts_with(name + "-")) continue;
    SCOPED_TRACE(entry.path());
    run(target, file_bytes(entry.path()));
  }
}

std::string random_bytes(std::uint64_t seed, size_t most) {
  std::mt19937_64 random(seed);
  std::string bytes(random() % most, '\0');
  for (char& c : bytes) c = static_cast<char>(random());
  return bytes;
}

TEST(FuzzReplay, FindsStayMended) {
  for (const auto& entry : fs::directory_iterator(ARBOC_SOURCE_DIR "/tests/fuzz/finds")) {
    const std::string name = entry.path().filename().string();
    const std::string target = name.substr(0, name.find('-'));
    EXPECT_TRUE(name == "README" || target == "read" || target == "compile" || target == "graph")
        << name << " is replayed by no target";
  }
  replay("read", fuzz::read);
  replay("compile", fuzz::compile);
  replay("graph", fuzz::graph);
}

TEST(FuzzReplay, MutantsOfGoodFilesAreReadOrRefused) {
  std::vector<std::string> files{chain_text(3)};
  for (const char* model : {"double_pendulum", "ur5", "all_joints"})
    files.push_back(
        file_bytes(ARBOC_SOURCE_DIR "/models/" + std::string(model) + "/" + model + ".urdf"));
  for (const std::uint64_t seed : seeds(400)) {
    std::string text = files[seed % files.size()];
    for (std::uint64_t k = 0; k <= seed % 5; ++k) text = fuzz::mutate_markup(text, 31 * seed + k);
    SCOPED_TRACE(text);
    run(fuzz::read, text);
  }
}

TEST(FuzzReplay, RandomRobotsCompileToWhatTheReferenceEngineSays) {
  for (const std::uint64_t seed : seeds(60)) run(fuzz::compile, random_bytes(seed, 300));
}

TEST(FuzzReplay, RandomGraphsKeepTheirValue) {
  for (const std::uint64_t seed : seeds(300)) run(fuzz::graph, random_bytes(seed, 600));
}

}  // namespace
}  // namespace arboc::test
