# Help, version and the lists, as a user sees them.
try carom --help
carom --version | sed 's/[0-9][0-9]*/N/g'
for command in resolve trace sweep verify experiments bench report kernels; do
  echo "--- $command"
  try carom "$command" --help
done
echo "--- the table"
try carom kernels | sed '/^configurations/s/:.*/:/; /rsqrt14/d' # what depends on the machine
