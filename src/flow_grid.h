// A gridded flow from a file: keeps the frames that the present time needs.

#ifndef LMP_FLOW_GRID_H
#define LMP_FLOW_GRID_H

#include "grid_file.h"

#include "flow/grid_flow.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FlowGrid : public GridFile {
 public:
  struct Options {
    bool loop = false;          // the series begins again when it is over
    bool clamp = false;         // outside the grid the fluid is that of its border
    bool reconstruct = true;    // velocity next to walls is made to meet no-slip

    // The keyword at iarg, if it is one of these; returns the index of the next one.
    int parse(LAMMPS *, int iarg, int narg, char **arg);
  };

  // iarg: the file's word in the command, for errors
  FlowGrid(LAMMPS *, const std::string &path, const Options &, int iarg);

  // All ranks call these.
  void
      require(apf::Detail);    // the records shall hold that much; they do when set_time was called
  void set_time(double time);    // reads what is missing

  bool series() const { return !times.empty(); }
  double file_time() const { return now; }    // in the series, when it loops
  bool has_distance() const { return known_distance; }
  apf::GridFlow flow() const;    // valid until require or set_time
  double memory_usage() const;

 private:
  Options options;
  bool known_distance = false;
  std::vector<double> times;
  std::vector<double> distance;    // of the rank that reads
  apf::Detail detail = apf::Detail::VELOCITY;
  std::size_t size = 0;          // numbers of a frame
  int frame_in[2] = {-1, -1};    // which frames are in memory: even ones in 0, odd ones in 1
  int interval = 0;              // frames before and after now
  double now = 0.0, share = 0.0;
  bool told_of_repeated = false;    // a warning of the first frame tells of all

  void warn_of_doubts() const;
  void check_repeated(const std::vector<double> &values);
  void load(int frame);
};

}    // namespace LAMMPS_NS

#endif
