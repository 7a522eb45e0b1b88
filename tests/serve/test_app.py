import sys, pathlib
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import standins
standins.install()
import time
from concurrent.futures import ThreadPoolExecutor
from starlette.testclient import TestClient
from cadgraph.serve.app import make_app
from cadgraph.serve.guard import Doors
from cadgraph.serve.plant import Plant, order_of
from cadgraph.session.demo import DEMO_SCENE
import shutil

def test_it(tmp_path):
    scene = tmp_path / "plant.usdc"
    shutil.copy(DEMO_SCENE, scene)
    page = tmp_path / "page"; page.mkdir(); (page / "index.html").write_text("hello"); (page/"viewer.js").write_text("1"); (page/"viewer.css").write_text("")
    order = order_of(scene, tmp_path / "out", None, None)
    order.prepare()
    t=time.time(); plant = Plant(order, "me"); plant.open(); print("open", time.time()-t, plant.feed.state)
    client = TestClient(make_app(plant, ThreadPoolExecutor(1), "tok", Doors("127.0.0.1", 8000), page), base_url="http://127.0.0.1:8000", headers={"authorization": "Bearer tok"})
    assert client.get("/").status_code == 403
    r = client.get("/?token=tok"); print(r.status_code, r.headers)
    for path in ("state","content","scene","scene/instances.bin","part/part-00001","trace?at=P-001","isolate?at=P-001","review?limit=2","audit", "nothing", "scene/../x", "unit/unit-001"):
        r = client.get("/api/"+path); print(path, r.status_code, r.text[:150])
    part = client.get("/api/review?limit=1").json()[0]
    for i in range(3):
        t=time.time(); r = client.post("/api/answer", json={"version": 1+i, "question": client.get("/api/review?limit=1").json()[0]["id"], "option": 0}); print(r.status_code, r.text[:300], time.time()-t)
    r = client.post("/api/undo", json={"version": 4}); print(r.text[:400])
    r = client.post("/api/undo", json={"version": 4}); print(r.status_code, r.text[:400])
    r = client.get("/api/audit"); print(r.text)
    t=time.time(); plant.close(); print("close", time.time()-t)
    print([p.name for p in (tmp_path/"out").iterdir()])
    again = Plant(order_of(scene, tmp_path / "out", None, None), "me")
    t=time.time(); again.open(); print("reopen", time.time()-t, again.feed.state); again.close()
