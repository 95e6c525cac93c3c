// SPDX-License-Identifier: MIT
// Wrong on purpose, and built by nobody: .ci/lint passes only if the linter reports every check named in an "expect" comment here. A
// check that was switched off or misspelt in .clang-tidy is found that way.
int counter = 0;                                          // expect cppcoreguidelines-avoid-non-const-global-variables
int half(int x) { return x == 3 || x == 3 ? 1 : x / 2; }  // expect misc-redundant-expression
const char* nothing() { return 0; }                       // expect modernize-use-nullptr
void finish(void) { return; }                             // expect readability-redundant-control-flow
int first(int* values) { return *values; }                // expect readability-non-const-parameter
unsigned long wide(int a, int b) { return a * b; }        // expect bugprone-implicit-widening-of-multiplication-result
struct Base {
  virtual ~Base() = default;
  virtual void go();
};
struct Derived : Base {
  virtual void go();  // expect modernize-use-override
};
struct Heavy {
  Heavy(const Heavy&);
  ~Heavy();
};
void keep(const Heavy heavy) { (void)sizeof(heavy); }  // expect performance-unnecessary-value-param
