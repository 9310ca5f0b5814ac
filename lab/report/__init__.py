"""The report: measures by the programs of the build, derives, draws, and writes one page. docs/study/report.md says more."""
