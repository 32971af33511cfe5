"""The command line as a whole."""


def test_without_a_command_the_commands_are_listed(lad_study):
    """As help, on lines of their own."""
    said = lad_study()
    assert said.code == 0
    assert said.err == ""
    for command in ("run", "report", "reproduce", "replay", "validate", "check", "show"):
        assert any(line.strip().startswith(f"{command} ") for line in said.out.splitlines())


def test_help_and_version_come_before_any_command(lad_study):
    """The same help when asked for; a version without it."""
    assert lad_study("--help").out == lad_study().out
    said = lad_study("--version")
    assert said.out.startswith("lad-study ")
    assert "Commands" not in said.out
