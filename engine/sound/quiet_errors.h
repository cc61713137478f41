// While one exists, nothing that libraries write to stderr of their own is seen: sound systems that find no
// card say so in a dozen lines, where one sentence of ours is enough.
#pragma once

namespace ag {

class QuietErrors {
  public:
    QuietErrors();
    ~QuietErrors();
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    int kept_ = -1;
};

}  // namespace ag
