// The fuzz targets: each takes any bytes and aborts where the program breaks a promise.
#pragma once
#include <cstddef>
#include <cstdint>

namespace arboc::fuzz {

/// Bytes of a model file.  They give a model that later stages can take, or errors with places.
void read(const std::uint8_t* data, size_t size);

/// Bytes that choose a robot, its names and numbers, the way it is written down, and options.  It
/// is read as it was meant, and what is compiled of it agrees with the reference engine and quotes
/// nothing of the names.
void compile(const std::uint8_t* data, size_t size);

/// Bytes that choose a graph.  Passes, scheduling, text and canonical order keep its value.
void graph(const std::uint8_t* data, size_t size);

}  // namespace arboc::fuzz
