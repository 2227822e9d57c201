// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// Interface of the LAMMPS plugin to the solver's program. Both are built together: this is no interface for
/// others.
namespace tripoint::ranks {

/// Facts that a plugin was built with, or finds as it is loaded.
struct Facts {
  int lammps = 0;                                               ///< version as a date, 20250722
  int bytes_of_id = 0, bytes_of_count = 0, bytes_of_image = 0;  ///< LAMMPS's tagint, bigint, imageint
  std::string mpi;                                              ///< library and version, "MPICH 5.0.2"
};

/// The particles of this rank, as LAMMPS's atoms: decomposed, migrated and copied to where they are near by
/// LAMMPS.
class Ranks {
 public:
  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;
  [[nodiscard]] virtual std::size_t owned() const = 0;       ///< atoms of its own; ghosts follow them
  [[nodiscard]] virtual std::size_t all() const = 0;         ///< with ghosts
  [[nodiscard]] virtual int id(std::size_t atom) const = 0;  ///< of all ranks, from 0
  /// From now on the atom carries that particle: its place, row and lists are to be written.
  virtual void set_id(std::size_t atom, int id) = 0;
  [[nodiscard]] virtual double* position(std::size_t atom) const = 0;  ///< x, y, z [m]
  /// Writes the numbers of rows of the solver, each to its own place. It is asked for those that other ranks
  /// are to have.
  using Write = std::function<void(std::span<const std::size_t> rows, std::span<double* const> to)>;
  /// Each atom of its own stands for a row, until balance() and migrate(). Arrived numbers are forgotten.
  virtual void set_rows(std::span<const std::size_t> rows, Write) = 0;
  static constexpr std::size_t no_row = ~std::size_t{0};
  /// That it stood for; no_row: it has arrived
  [[nodiscard]] virtual std::size_t row(std::size_t atom) const = 0;
  /// Its numbers. @pre it has no row
  [[nodiscard]] virtual const double* arrived(std::size_t atom) const = 0;
  /// Bonds and excluded pairs, as numbers that go with the atom; no more of them than make_room() was told.
  [[nodiscard]] virtual std::vector<double>& lists(std::size_t atom) const = 0;
  virtual void make_room(std::size_t lists) = 0;
  /// Cost of the atom in a step, in a unit of any kind: goes with it.
  [[nodiscard]] virtual double& cost(std::size_t atom) const = 0;
  /// Moves the cuts between ranks so that each has atoms of about equal cost, where the dearest has over
  /// `allowed` of the mean.
  virtual void balance(double allowed) = 0;
  [[nodiscard]] virtual long cuts_moved() const = 0;  ///< how often that was
  /// Atoms go to the rank that has their place, and are copied to those that it is near to. @param reach of
  /// ghosts [m]
  /// @throws EngineError when LAMMPS has lost one
  virtual void migrate(double reach) = 0;
  /// Columns that ghosts take from their owners; a row has one number in each.
  struct Columns {
    double* const* first;  ///< number of row 0 in each column
    int count;
    const std::uint32_t* ids;   ///< of each atom
    const std::uint32_t* rows;  ///< of each id; null: an id is its row
    std::size_t stride;         ///< from the number of a row to that of the next
  };
  virtual void forward(const Columns&) = 0;
  virtual void add(double* numbers, int count) = 0;
  /// The least of all ranks, and the word beside it. @param word of `length` characters
  virtual void take_least(double& number, char* word, int length) = 0;
  /// Numbers of all ranks, one rank after the other, on each of them. @throws EngineError for more than 2^31
  [[nodiscard]] virtual std::vector<double> all_of(const std::vector<double>& own) = 0;
  /// Numbers for each rank. @return those that each has for this one, by rank   @throws EngineError for more
  /// than 2^31
  [[nodiscard]] virtual std::vector<std::vector<double>> exchange(
      const std::vector<std::vector<double>>& to) = 0;
  /// Numbers of all ranks, one rank after the other, on rank 0 alone; nothing on others.
  [[nodiscard]] virtual std::vector<double> gather(const std::vector<double>& own) = 0;
  [[nodiscard]] virtual double bytes_sent() const = 0;  ///< by this rank for ghosts, so far

 protected:
  ~Ranks() = default;  // LAMMPS ends it
};

}  // namespace tripoint::ranks

/// Symbols of the plugin that the program asks for.
extern "C" {
const tripoint::ranks::Facts* tripoint_built_with();
/// Facts about the libraries that are there. @param lammps an instance of LAMMPS, or null: its version and
/// sizes are then 0
const tripoint::ranks::Facts* tripoint_found(void* lammps);
/// The fix of this process; null before it is made.
tripoint::ranks::Ranks* tripoint_ranks();
int tripoint_rank();
int tripoint_size();
void tripoint_abort(int code);
/// From now on this is called, with MPI's own words, where a call of MPI fails. It does not return.
void tripoint_on_fault_of_mpi(void (*report)(const char* words));
}
