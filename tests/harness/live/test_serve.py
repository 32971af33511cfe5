"""Where a live study is served, by which links, and by which plan."""

import json

import pytest

from harness.live import serve
from harness.live.serve import Address, serve_study
from harness.live.study import REVOKED, LiveStudy
from harness.session.study_run import StudyRun
from protocols.files.errors import InputError
from protocols.load import resolve_study
from protocols.record.check import check_study
from protocols.registered_study import registered
from protocols.registration import read_registration, write_registration


@pytest.fixture
def asked(monkeypatch):
    """Have nothing served; return the hosts and origins that would be answered."""
    answered = []

    async def nothing(*_):
        pass

    monkeypatch.setattr(serve, "_serve", nothing)
    monkeypatch.setattr(serve, "web_server", lambda _, *who: answered.extend(who))
    return answered


@pytest.fixture
def run():
    """Return a study with living people."""
    return StudyRun(resolve_study("four-lap-live", participants=2), 3)


def test_only_this_machine_by_default(asked, run, tmp_path):
    """Three links to 127.0.0.1 or localhost; they are written as JSON, too."""
    said = []
    serve_study(run, tmp_path / "s", Address(port=0), said.append, links=tmp_path / "links.json")
    hosts, origins = asked
    assert {host.split(":")[0] for host in hosts} == {"localhost", "127.0.0.1"}
    assert origins == {f"http://{host}" for host in hosts}
    links = json.loads((tmp_path / "links.json").read_text())
    assert [line.split()[0] for line in said] == list(links)
    assert list(links) == ["participant", "demonstrator", "experimenter"]


def test_new_links_replace_the_old_ones(asked, run, tmp_path):
    """The same command prints the same links; with --new-links others, and the old ones go."""
    printed = []
    for new_links in (False, False, True, False):
        said = []
        serve_study(run, tmp_path / "s", Address(port=0), said.append, new_links=new_links)
        printed.append([line.rpartition("/")[2] for line in said])
    assert printed[0] == printed[1]
    assert printed[2] == printed[3]
    tokens = LiveStudy(run, tmp_path / "s").tokens
    assert [tokens.read(token) for token in printed[0]] == [None] * 3
    assert [tokens.read(token).role for token in printed[2]] == [
        "participant", "demonstrator", "experimenter",
    ]  # fmt: skip


def test_a_damaged_list_of_revoked_links_is_refused(asked, run, tmp_path):
    """In one line: without it, links that were revoked would open again."""
    LiveStudy(run, tmp_path / "s").new_links()
    (tmp_path / "s.private" / REVOKED).write_text("{")
    with pytest.raises(InputError, match=r"revoked\.json: damaged; allowed: .*--new-links"):
        serve_study(run, tmp_path / "s", Address(port=0), print)


def test_the_local_network_gets_links_with_qr_codes(asked, run, tmp_path, monkeypatch):
    """Other machines use this one's address; it is said what plain http lacks."""
    monkeypatch.setattr(serve, "_lan_address", lambda: "192.0.2.7")
    said = []
    serve_study(run, tmp_path / "s", Address(port=0, lan=True), said.append)
    assert any(host.startswith("192.0.2.7:") for host in asked[0])
    assert said[0].split()[1].startswith("http://192.0.2.7:")
    assert "█" in said[1] or "▀" in said[1]
    assert "no gamepad" in said[-1]


def test_behind_a_proxy_the_links_have_its_address(asked, run, tmp_path):
    """The declared origin is answered, and so is its host."""
    said = []
    address = Address(port=0, public_origin="https://study.example.org")
    serve_study(run, tmp_path / "s", address, said.append)
    hosts, origins = asked
    assert "study.example.org" in hosts
    assert "https://study.example.org" in origins
    assert said[0].split()[1].startswith("https://study.example.org/p/")


@pytest.mark.parametrize("origin", ["study.example.org", "ftp://x", "https://x/path", "https://"])
def test_what_is_no_origin_is_refused(run, tmp_path, origin):
    """In one line, before anything is made."""
    with pytest.raises(InputError, match=r"--public-origin: .*; allowed: https://HOST"):
        serve_study(run, tmp_path / "s", Address(port=0, public_origin=origin), print)
    assert not (tmp_path / "s").exists()


@pytest.mark.usefixtures("asked")
def test_links_stay_the_same_after_a_restart(run, tmp_path):
    """Whoever has a link can use it again; the key is beside the study, readable by the owner."""
    links = []
    for _ in range(2):
        said = []
        serve_study(run, tmp_path / "s", Address(port=0), said.append)
        links.append([line.rpartition("/")[2] for line in said])
    assert links[0] == links[1]
    assert (tmp_path / "s.private" / "links.key").stat().st_mode & 0o077 == 0


@pytest.mark.usefixtures("asked")
def test_a_registered_plan_is_kept(run, tmp_path):
    """Its bytes lie in the study directory before anyone takes part."""
    write_registration(run.study, tmp_path / "plan")
    plan = read_registration(tmp_path / "plan")
    follows = StudyRun(registered(run.study, plan), 3)
    serve_study(follows, tmp_path / "s", Address(port=0), print, plan=plan)
    kept = read_registration(tmp_path / "s" / "registration")
    assert kept.digest == plan.digest
    faults = check_study(tmp_path / "s")  # tables come with the first session
    (fault,) = (fault for fault in faults if "sessions are missing" in fault)
    assert fault.startswith("2 of 2 sessions are missing; `lad-study live four-lap-live ")
    assert not any("is not the registration" in fault for fault in faults)
    assert f"--registration {tmp_path / 's' / 'registration'}`" in fault
