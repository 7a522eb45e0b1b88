/* cadgraph viewer, Apache-2.0; with three.js and three-mesh-bvh, both MIT: see THIRD_PARTY.txt */
var bn=class extends Error{status;state;constructor(t,e,n=null){super(t),this.name="Refused",this.status=e,this.state=n}},uf="cadgraph-data-";function df(){return document.getElementById(`${uf}content`)?new lh:new ah(Zx())}function Zx(){return new URLSearchParams(location.search).get("token")??""}var ah=class{live=!0;headers;constructor(t){this.headers={Authorization:`Bearer ${t}`}}state=()=>this.json("api/state");content=()=>this.json("api/content");manifest=()=>this.json("api/scene");review=(t=50)=>this.json(`api/review?limit=${t}`);audit=()=>this.json("api/audit");async file(t,e){return(await this.call(`api/scene/${encodeURIComponent(t)}`,{signal:e})).arrayBuffer()}async schematic(){return(await this.call("api/schematic")).text()}async explain(t,e){return(await this.json(`api/${t}/${encodeURIComponent(e)}`)).lines}trace(t,e,n){let s=new URLSearchParams({at:t,direction:e,...n?{to:n}:{}});return this.json(`api/trace?${s}`)}isolate(t){return this.json(`api/isolate?${new URLSearchParams({at:t})}`)}edit=(t,e,n="")=>this.post("api/edit",{version:t,edits:e,why:n});undo=t=>this.post("api/undo",{version:t});redo=t=>this.post("api/redo",{version:t});answer=(t,e,n,s="")=>this.post("api/answer",{version:t,question:e,option:n,why:s});async follow(t,e,n){let s=500;for(;!t.aborted;){try{let o=(await this.call("api/events",{signal:t})).body.pipeThrough(new TextDecoderStream).getReader(),a="";for(;;){let{done:l,value:c}=await o.read();if(l)break;s=500,a+=c;let h;for(;(h=a.indexOf(`

`))>=0;){let u=a.slice(0,h).split(`
`).filter(d=>d.startsWith("data:")).map(d=>d.slice(5).trim()).join(`
`);a=a.slice(h+2),u&&e(JSON.parse(u))}}}catch(r){if(t.aborted)return;if(r instanceof bn&&r.status===403){n(r.message);return}}if(t.aborted)return;n("The server does not answer. Corrections that were confirmed are kept; start 'cadgraph view' again."),await new Promise(r=>setTimeout(r,s)),s=Math.min(2*s,5e3)}}async json(t){return(await this.call(t)).json()}async post(t,e){let n={...this.headers,"Content-Type":"application/json"};return(await this.call(t,{method:"POST",body:JSON.stringify(e),headers:n})).json()}async call(t,e={}){let n;try{n=await fetch(t,{headers:this.headers,...e})}catch(s){throw s instanceof DOMException&&s.name==="AbortError"?s:new bn("The server does not answer; start 'cadgraph view' again. Nothing confirmed is lost.",0)}if(!n.ok){let s=await n.json().catch(()=>({}));throw new bn(s.error??`The server answered with ${n.status}.`,n.status,s.state??null)}return n}},hf="This file is for looking only; corrections are made with 'cadgraph view'.",lh=class{live=!1;async state(){let t=await this.content();return{status:"ready",stage:"",share:1,message:"",version:t.version,read_only:hf,title:t.title,folder:"",can_undo:!1,can_redo:!1,undo:null,redo:null,n_edits:0,lost:[],who:""}}follow=()=>Promise.resolve();content=async()=>JSON.parse(await this.text("content"));manifest=async()=>JSON.parse(await this.text("manifest"));file=t=>this.bytes(t);schematic=()=>this.text("schematic");explain=()=>Promise.resolve([]);review=()=>Promise.resolve([]);audit=()=>Promise.resolve([]);trace=()=>this.refuse();isolate=()=>this.refuse();edit=()=>this.refuse();undo=()=>this.refuse();redo=()=>this.refuse();answer=()=>this.refuse();refuse(){return Promise.reject(new bn(hf,403))}async text(t){return new TextDecoder().decode(await this.bytes(t))}async bytes(t){let e=document.getElementById(uf+t);if(!e)throw new bn(`This file lacks ${t}; export it again.`,404);let n=Uint8Array.from(atob((e.textContent??"").trim()),r=>r.charCodeAt(0)),s=new Blob([n]).stream().pipeThrough(new DecompressionStream("deflate"));return new Response(s).arrayBuffer()}};var Fo=new Map;function ii(...i){for(let t of i)Fo.set(t.id,t)}function Uo(){return[...Fo.values()]}function zn(i){let t=Fo.get(i);t&&(t.when?.()??!0)&&t.run()}function Jx(i){return i.key==="Escape"||i.ctrlKey&&!/^[acvxyz]$/i.test(i.key)}function ff(i){i.addEventListener("keydown",t=>{let e=t,n=e.target,s=!!n&&(n.isContentEditable||/^(INPUT|TEXTAREA|SELECT)$/.test(n.tagName));if(e.defaultPrevented||e.altKey||s&&!Jx(e))return;let o=/^[a-z]$/i.test(e.key)?e.shiftKey?e.key.toUpperCase():e.key.toLowerCase():e.key,a=e.shiftKey&&o.length>1?"Shift+":"",l=`${e.ctrlKey||e.metaKey?"Ctrl+":""}${a}${o}`;for(let c of Fo.values())if(c.key===l&&(c.when?.()??!0)){e.preventDefault(),c.run();return}})}function zo(i,t){if(i.meshes===t.meshes)return s=>s;let e=new Map(t.meshes.path.map((s,r)=>[s,t.meshes.part[r]])),n=new Map;return i.meshes.part.forEach((s,r)=>{let o=e.get(i.meshes.path[r])??-1;s>=0&&o>=0&&!n.has(s)&&n.set(s,o)}),s=>n.get(s)??-1}function Es(i,t,e){let n=zo(i,e),s=i.network.units.find(o=>o.id===t);if(s)return Kx(s,n,e.network.units);let r=i.network.ends.find(o=>o.id===t);return r?jx(r,n,e.network.ends):null}function Kx(i,t,e){let n=new Set(i.parts.map(t)),s=a=>a.parts.filter(l=>n.has(l)).length,r=a=>{let l=s(a),c=l===n.size&&l===a.parts.length;return l===0?-1:4*l+(c?2:0)+(a.id===i.id?1:0)},o=e.reduce((a,l)=>r(l)>(a?r(a):0)?l:a,null);return o&&2*s(o)>=n.size?o:null}function jx(i,t,e){let n=Bo(i.parts.map(t)),s=e.filter(o=>o.kind==="junction"==(i.kind==="junction")),r=n?s.filter(o=>Bo(o.parts)===n):[];if(i.kind==="junction"&&r.length===1)return r[0];for(let o of[r,s]){let a=Qx(o,i.point);if(a&&ch(a.point,i.point)<=.01)return a}return null}function Qx(i,t){return i.reduce((e,n)=>e&&ch(e.point,t)<=ch(n.point,t)?e:n,null)}var ch=(i,t)=>Math.hypot(t[0]-i[0],t[1]-i[1],t[2]-i[2]),Bo=i=>[...i].sort((t,e)=>t-e).join(",");function xf(i,t,e){let n=i.network.lines[t];if(!n)return-1;let s=zo(i,e),r=gf(i,n,mf(i),s),o=mf(e),a=e.network.lines.findIndex(c=>c.connections.length===n.connections.length&&gf(e,c,o)===r);if(a>=0)return a;let l=pf(i,n,s);return e.network.lines.findIndex(c=>{let h=pf(e,c),u=[...h].filter(d=>l.has(d)).length;return 2*u>h.size+l.size-u})}var vf=i=>i;function pf(i,t,e=vf){return new Set(t.connections.flatMap(n=>i.network.connections[n].via.map(e)))}function mf({network:{units:i,ends:t}}){return new Map([...t,...i].map(e=>[e.id,e]))}function gf(i,t,e,n=vf){return t.connections.map(s=>tv(i.network.connections[s],e,n)).sort().join(" ")}function tv(i,t,e){let n=[i.source,i.target].map(s=>ev(s,t,e)).sort();return`${Bo(i.via.map(e))}|${n.join("|")}`}function ev(i,t,e){let n=t.get(i);return n?n.parts.length?Bo(n.parts.map(e)):n.point.map(s=>Math.round(s/.01)).join(","):i}var nv={junction:"junction",open:"open end",blind:"closed end",unknown:"end of a pipe"};function Pr(i){let t={content:i,places:new Map,named:new Map,placeOfPart:new Map,connectionsOfPart:new Map};for(let e of i.network.units)yf(t,iv(e));for(let e of i.network.ends)yf(t,sv(e));return i.network.connections.forEach((e,n)=>{for(let s of new Set([e.source,e.target]))t.places.get(s)?.connections.push(n);for(let s of e.via)rv(t.connectionsOfPart,s,n)}),t}function iv(i){return{id:i.id,name:i.tag,type:i.type,what:i.kind??i.type,point:i.point,size:i.size,parts:i.parts,system:i.system,unit:i,connections:[]}}function sv(i){return{id:i.id,name:i.name,type:i.kind,what:nv[i.kind],point:i.point,size:null,parts:i.parts,system:i.system,unit:null,connections:[]}}function yf(i,t){i.places.set(t.id,t),i.named.has(t.name)?i.named.set(t.name,""):i.named.set(t.name,t.id);for(let e of t.parts)i.placeOfPart.has(e)||i.placeOfPart.set(e,t.id)}function rv(i,t,e){let n=i.get(t);n?n.push(e):i.set(t,[e])}function bf(i,t){let e=new Set;for(let n of t.connections){let s=i.content.network.connections[n];for(let r of s.via)e.add(r);for(let r of[s.source,s.target])r!==t.start&&r!==t.end&&i.places.get(r)?.parts.forEach(o=>e.add(o))}return[...e]}function wf(i,t,e){let n=new Set;for(let s of t)i.places.get(s)?.parts.forEach(r=>n.add(r));for(let s of e)i.content.network.connections[s]?.via.forEach(r=>n.add(r));return n}function Vo(i,t){return i.source===t?{id:i.target,name:i.target_name}:{id:i.source,name:i.source_name}}function _f(i,t){let e=t.start;return t.connections.map(n=>{let s=i.content.network.connections[n],r=s.source===e;return e=r?s.target:s.source,{row:n,along:r}})}var Ho=class{answer=null;picking=null;busy=!1;refusal=null;turn=0;listeners=new Set;store;source;panels;planNow;constructor(t,e,n,s){this.store=t,this.source=e,this.panels=n,this.planNow=s,t.watch(["place","selection"],()=>this.picked()),t.watch(["marks"],()=>queueMicrotask(()=>{this.answer&&!this.busy&&t.shown.marks===null&&this.clear()}))}onChange(t){this.listeners.add(t)}trace(t,e){return this.ask({kind:"trace",at:t,direction:e,to:null})}isolate(t){return this.ask({kind:"isolate",at:t,direction:"downstream",to:null})}startPick(t){this.picking=this.picking===t?null:t,this.tell()}tick(t,e){e?this.answer?.ticked.add(t):this.answer?.ticked.delete(t),this.tell()}clear(){this.turn++,this.answer=null,this.picking=null,this.busy=!1,this.refusal=null,this.store.set({marks:null}),this.tell()}again(t){if(this.picking!==null&&(this.picking=Es(t,this.picking,this.planNow().content)?.id??null),!this.answer)return;let{query:e,ticked:n,content:s}=this.answer,r=l=>Es(s,l,this.planNow().content)?.id,o=r(e.at),a=e.to===null?null:r(e.to);if(o===void 0||a===void 0){this.clear(),this.panels.say("What was traced is no longer in the network.");return}this.ask({...e,at:o,to:a},new Set([...n].flatMap(l=>r(l)??[])))}picked(){let t=this.store.shown.place??this.planNow().placeOfPart.get(this.store.shown.selection[0])??null;if(this.picking===null||t===null||t===this.picking)return;let e=this.picking;this.picking=null,this.ask({kind:"trace",at:e,direction:"downstream",to:t})}async ask(t,e=new Set){let n=++this.turn;this.busy=!0,this.refusal=null,this.tell();let{content:s}=this.planNow();try{let r=await this.result(t);if(n!==this.turn)return;this.answer={query:t,result:r,ticked:new Set([...e].filter(o=>Go(r).includes(o))),content:s},s===this.planNow().content?this.store.set({marks:this.marksOf(this.answer)}):this.again(s)}catch(r){if(!(r instanceof bn))throw r;if(n!==this.turn)return;this.answer=null,this.refusal=r.message,this.store.set({marks:null}),this.panels.say(r.message,"bad")}finally{n===this.turn&&(this.busy=!1,this.tell())}}async result(t){let e=this.nameOf(t.at);if(t.kind==="isolate")return this.source.isolate(e);if(t.to===null)return this.source.trace(e,t.direction);let n=this.nameOf(t.to),s=await this.source.trace(e,"downstream",n);if(s.places.includes(t.to))return s;let r=await this.source.trace(e,"upstream",n);return r.places.includes(t.to)?r:s}nameOf(t){let{places:e,named:n}=this.planNow(),s=e.get(t)?.name??t;return n.get(s)===t?s:t}marksOf({query:t,result:e}){let n=Go(e),s=new Set([t.at,...e.places,...n]),r=new Set(e.connections);return{kind:t.kind,result:e,places:s,connections:r,parts:wf(this.planNow(),s,r),close:new Set(n)}}tell(){for(let t of this.listeners)t()}};function Go(i){return"close"in i?i.close:[]}function hh(i){return i.sure&&i.doubts.length===0}function y(i,t={},...e){let n=document.createElement(i),{text:s,value:r,...o}=t;return Sf(n,o),s!==void 0&&(n.textContent=String(s??"")),r!==void 0&&(n.value=String(r??"")),de(n,...e),n}function se(i,t={},...e){let n=document.createElementNS("http://www.w3.org/2000/svg",i);return Sf(n,t),n.append(...e),n}function Sf(i,t){for(let[e,n]of Object.entries(t))typeof n=="function"?i.addEventListener(e.slice(2),n):n===!0?i.setAttribute(e,""):n!==!1&&n!==null&&n!==void 0&&i.setAttribute(e,String(n))}function de(i,...t){for(let e of t)e==null||e===!1||i.append(e instanceof Node?e:String(e))}function Lt(i,...t){i.replaceChildren(),de(i,...t)}function Wo(i){for(let t of["pointerdown","click","dblclick"])i.addEventListener(t,e=>e.stopPropagation());i.addEventListener("pointermove",t=>{t.buttons||t.stopPropagation()})}function uh(i,{section:t},e){if(!t)return!1;let{center:n,size:s}=i.parts,r=3*e+"xyz".indexOf(t.axis);return t.flipped?n[r]+s[r]/2<t.at:n[r]-s[r]/2>t.at}function Mf(i,t,e){let n={};e.some(r=>t.hidden.has(r))&&(n.hidden=new Set([...t.hidden].filter(r=>!e.includes(r))));let{isolated:s}=t;return s&&!e.every(r=>s.has(r))&&(n.isolated=null),e.some(r=>uh(i,t,r))&&(n.section=null),n}var $o=class{linesBy="flow";moving=!1;warning=null;warnings=!0;line=null;hoveredLine=-1;listeners=new Set;store;planNow;constructor(t,e){this.store=t,this.planNow=e}onChange(t){this.listeners.add(t)}set(t){Object.assign(this,t),this.tell()}selectLine(t){let e=this.planNow(),n=e.content.network.lines[t];if(!n)return;let s=bf(e,n);this.line={row:t,selection:s},this.store.select(s),this.tell()}keepLine(t){this.hoveredLine=-1;let e=this.selectedLine;if(e<0)return!0;this.line=null;let n=xf(t,e,this.planNow().content);return n>=0?this.selectLine(n):this.store.select([]),n>=0}hoverLine(t){t!==this.hoveredLine&&(this.hoveredLine=t,this.tell(!0))}hoverPlace(t){let e=t===null?void 0:this.planNow().places.get(t)?.parts[0];this.store.set({hovered:e??-1})}get selectedLine(){return this.line&&this.line.selection===this.store.shown.selection?this.line.row:-1}get place(){let t=this.planNow(),{place:e,selection:n}=this.store.shown;if(e)return t.places.get(e)??null;if(this.selectedLine>=0||n.length===0)return null;let s=new Set(n.map(o=>t.placeOfPart.get(o))),[r]=s;return s.size===1&&r?t.places.get(r)??null:null}get connections(){let t=this.planNow();if(this.selectedLine>=0)return new Set(t.content.network.lines[this.selectedLine].connections);let e=new Set;if(this.store.shown.place||this.store.shown.selection.length>40)return e;for(let n of this.store.shown.selection)t.placeOfPart.has(n)||t.connectionsOfPart.get(n)?.forEach(s=>e.add(s));return e}get hoveredConnections(){let t=this.planNow(),e=t.content.network.lines[this.hoveredLine];if(e)return new Set(e.connections);let{hovered:n}=this.store.shown;return new Set(t.placeOfPart.has(n)?[]:t.connectionsOfPart.get(n)??[])}get hoveredPlace(){return this.planNow().placeOfPart.get(this.store.shown.hovered)??null}get hovered(){return this.hoveredLine}isPartShown(t){let{shown:e}=this.store;return!e.hidden.has(t)&&(e.isolated===null||e.isolated.has(t))&&!uh(this.planNow().content,e,t)}isPlaceShown(t){return t.parts.length===0||t.parts.some(e=>this.isPartShown(e))}isConnectionShown=t=>{let{via:e,source:n,target:s}=this.planNow().content.network.connections[t];if(e.length)return e.some(o=>this.isPartShown(o));let r=this.planNow().places;return[n,s].every(o=>this.isPlaceShown(r.get(o)))};tell(t=!1){for(let e of this.listeners)e(t)}};var ov=/[\p{L}\p{N}][\p{L}\p{N}_./-]*/gu;function Tf(i,t){let e=[],n=0;for(let s of i.matchAll(ov)){let r=s[0].replace(/[./-]+$/,""),o=t.named.get(r);o&&(s.index>n&&e.push({text:i.slice(n,s.index),place:null}),e.push({text:r,place:o}),n=s.index+r.length)}return n<i.length&&e.push({text:i.slice(n),place:null}),e}function Ef(i){return{indent:i.length-i.trimStart().length,cells:i.trim().split(/ {2,}/)}}function Af(i,t){let{result:e,query:n}=i,s=y("button",{type:"button","data-test":"net-clear",title:"End this and show everything again (c)",onclick:()=>t.asking.clear()},"Clear"),r=dh(i);return y("section",{class:"net-card","data-test":"net-answer","aria-label":r},y("header",{},y("h3",{},r),s),n.kind==="isolate"?av(e):null,lv(e.doubts,t),n.kind==="isolate"?cv(i,t):null,hv(e.lines,t,n.kind==="isolate"))}function Cf(i,t){let{result:e,query:n}=i;if(n.kind==="trace"){let l=e.doubts.length;return{text:`${dh(i)}${l?`: not certain, ${wn(l,"doubt")}`:""}`,certain:l===0}}let s=e,r=s.close.map(l=>t.places.get(l)?.name??l),o=r.length===0?"no valve found to close":`close ${r.slice(0,6).join(", ")}${r.length>6?` and ${r.length-6} more`:""}`,a=hh(s);return{text:`${a?"":"Not certain: "}${dh(i)}: ${o}`,certain:a}}function dh({result:{title:i}}){return i.charAt(0).toUpperCase()+i.slice(1)}function av(i){if(hh(i))return y("p",{class:"net-verdict"},"No doubt was found. That is what the model's geometry says: check it on site before anything is opened.");let t=i.doubts.length,e=t?`${wn(t,"doubt")} below must be cleared on site.`:"a way may stay open; read the steps below.";return y("p",{class:"net-verdict is-unsure",role:"alert"},y("strong",{},"Not certain. "),`Closing these valves may not cut it off: ${e}`)}function lv(i,t){return i.length?y("ul",{class:"net-doubts","aria-label":"Doubts"},...i.map(e=>{let n=()=>e.place!==null?t.go(e.place):t.goParts(e.parts),s=e.place!==null||e.parts.length>0,r=`Not certain: ${e.text}`;return y("li",{},s?y("button",{type:"button",class:"net-doubt","data-test":"net-doubt",onclick:n},r):y("span",{class:"net-doubt"},r))})):null}function cv(i,t){let e=Go(i.result);if(!e.length)return y("p",{class:"net-soft"},"No valve to close was found.");let n=e.filter(s=>i.ticked.has(s)).length;return y("div",{},y("h4",{},"To be closed ",y("span",{class:"net-soft"},`${n} of ${e.length} ticked off`)),y("ul",{class:"net-close"},...e.map(s=>{let r=t.plan.places.get(s),o=y("input",{type:"checkbox","data-test":"net-close-tick","data-id":s,"aria-label":`${r?.name??s} is closed`,checked:i.ticked.has(s),onchange:a=>t.asking.tick(s,a.target.checked)});return y("li",{},o,Oi(s,r?.name??s,t),y("span",{class:"net-soft"},r?.what??""))})))}function hv(i,t,e){if(!i.length)return null;let n=y("div",{class:"net-steps","data-test":"net-steps",tabindex:"0",role:"group","aria-label":"Steps"},...i.map(s=>{let{indent:r,cells:o}=Ef(s),a=y("div",{},...o.map(l=>y("span",{},...uv(l,t))));return a.style.setProperty("--indent",String(r)),a}));return e?y("details",{open:!0},y("summary",{},"How it was found"),n):n}function uv(i,t){return Tf(i,t.plan).map(e=>e.place===null?document.createTextNode(e.text):Oi(e.place,e.text,t))}function Oi(i,t,e){return y("button",{type:"button",class:"net-link","data-id":i,"data-test":"net-link",onclick:()=>e.go(i),onpointerenter:()=>e.focus.hoverPlace(i),onpointerleave:()=>e.focus.hoverPlace(null)},t)}function wn(i,t,e=`${t}s`){return`${i} ${i===1?t:e}`}function Rf(i,t,e,n,s){let r=[],{asking:o}=t;if(o.picking!==null){let l=t.plan.places.get(o.picking)?.name??"it";r.push(Pf(`Click where the way from ${l} should lead.`,"","Stop",()=>o.startPick(o.picking)))}if(o.answer){let{text:l,certain:c}=Cf(o.answer,t.plan);r.push(Pf(l,c?"":"is-unsure","Clear",()=>o.clear()))}let a=e[n];a&&r.push(dv(a,n,e.length,s)),i.replaceChildren(...r)}function Pf(i,t,e,n){return y("div",{class:`net-note ${t}`,role:"status","data-test":"net-note"},y("span",{},i),y("button",{type:"button","data-test":"net-note-end",onclick:n},e))}function dv(i,t,e,n){let s=(r,o,a,l)=>y("button",{type:"button","data-test":r,title:a,"aria-label":a,onclick:l},o);return y("div",{class:"net-note net-warning-card",role:"status","data-test":"net-warning-card"},y("div",{},y("strong",{},i.title),y("p",{},i.text)),y("div",{class:"net-note-tools"},s("net-warning-previous","\u2039","Previous warning (W)",()=>n.step(-1)),y("span",{},`${t+1} of ${e}`),s("net-warning-next","\u203A","Next warning (w)",()=>n.step(1)),s("net-warning-close","\xD7","Close",()=>n.close())))}var Xo=class{timer=0;view;store;focus;overlay;still=matchMedia("(prefers-reduced-motion: reduce)");slow;constructor(t,e,n,s){this.view=t,this.store=e,this.focus=n,this.overlay=s,this.slow=fv(t.element),this.still.addEventListener("change",()=>this.refresh())}refresh(){let t=this.isWanted();t&&!this.timer&&(this.timer=window.setInterval(()=>this.step(),50)),!t&&this.timer&&(clearInterval(this.timer),this.timer=0,this.overlay.setTime(-1),this.view.invalidate())}isWanted(){let{network:t,marks:e}=this.store.shown;return!t&&!e?!1:this.focus.moving?!0:e?.kind==="trace"&&!this.still.matches&&!this.slow&&this.view.stats.frameMs<8}step(){document.hidden||(this.overlay.setTime(performance.now()/1600%1),this.view.invalidate())}};function fv(i){let t=i.querySelector("canvas")?.getContext("webgl2"),e=t?.getExtension("WEBGL_debug_renderer_info"),n=t&&e?String(t.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return/swiftshader|llvmpipe|software/i.test(n)}var rp=0,qh=1,op=2;var Qr=1,ap=2,Ks=3,jn=0,tn=1,Oe=2,Qn=0,js=1,Yh=2,Zh=3,Jh=4,to=5;var fs=100,lp=101,cp=102,hp=103,up=104,dp=200,Ja=201,fp=202,pp=203,eo=204,Qs=205,mp=206,gp=207,xp=208,vp=209,yp=210,bp=211,wp=212,_p=213,Sp=214,ba=0,wa=1,_a=2,Gs=3,Sa=4,Ma=5,Ta=6,Ea=7,Kh=0,Mp=1,Tp=2,ui=0,jh=1,Qh=2,tu=3,eu=4,nu=5,iu=6,su=7;var ru=300,ps=301,tr=302,Ka=303,ja=304,Aa=1e3,oi=1001,Ca=1002,Se=1003,Ep=1004;var no=1005;var Xe=1006,Qa=1007;var Ci=1008;var en=1009,ou=1010,au=1011,er=1012,tl=1013,Mn=1014,Rn=1015,kn=1016,el=1017,nl=1018,ms=1020,lu=35902,cu=35899,hu=1021,uu=1022,je=1023,Ei=1026,Pi=1027,du=1028,io=1029,Yi=1030,il=1031;var sl=1033,so=33776,ro=33777,oo=33778,ao=33779,rl=35840,ol=35841,al=35842,ll=35843,cl=36196,hl=37492,ul=37496,dl=37488,fl=37489,lo=37490,pl=37491,ml=37808,gl=37809,xl=37810,vl=37811,yl=37812,bl=37813,wl=37814,_l=37815,Sl=37816,Ml=37817,Tl=37818,El=37819,Al=37820,Cl=37821,Pl=36492,Rl=36494,Ll=36495,Il=36283,kl=36284,co=36285,Nl=36286;var Dr=2300,Pa=2301,va=2302,Uh=2303,Bh=2400,zh=2401,Vh=2402;var Ap=3200;var fu=0,Cp=1,Ri="",Cn="srgb",Or="srgb-linear",Fr="linear",re="srgb";var ya=7680;var Pp=519,Rp=512,Lp=513,Ip=514,pu=515,kp=516,Np=517,mu=518,gu=519,Dp=35044,xu=35048;var gs="300 es",Hn=2e3,Ur=2001;function pv(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function mv(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Br(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function Op(){let i=Br("canvas");return i.style.display="block",i}var Lf={},Ws=null;function vu(...i){let t="THREE."+i.shift();Ws?Ws("log",t,...i):console.log(t,...i)}function Fp(i){let t=i[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=i[1];e&&e.isStackTrace?i[0]+=" "+e.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function It(...i){i=Fp(i);let t="THREE."+i.shift();if(Ws)Ws("warn",t,...i);else{let e=i[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...i)}}function kt(...i){i=Fp(i);let t="THREE."+i.shift();if(Ws)Ws("error",t,...i);else{let e=i[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...i)}}function Nr(...i){let t=i.join(" ");t in Lf||(Lf[t]=!0,It(...i))}function Up(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var Bp={[ba]:ba,[_a]:Ta,[Sa]:Sa,[Gs]:Ma,[wa]:wa,[Ta]:_a,[Ea]:Ea,[Ma]:Gs},li=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){let n=this._listeners;return n===void 0?!1:n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){let n=this._listeners;if(n===void 0)return;let s=n[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let n=e[t.type];if(n!==void 0){t.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},on=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"];var fh=Math.PI/180,Ra=180/Math.PI;function ho(){let i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(on[i&255]+on[i>>8&255]+on[i>>16&255]+on[i>>24&255]+"-"+on[t&255]+on[t>>8&255]+"-"+on[t>>16&15|64]+on[t>>24&255]+"-"+on[e&63|128]+on[e>>8&255]+"-"+on[e>>16&255]+on[e>>24&255]+on[n&255]+on[n>>8&255]+on[n>>16&255]+on[n>>24&255]).toLowerCase()}function Vt(i,t,e){return Math.max(t,Math.min(e,i))}function gv(i,t){return(i%t+t)%t}function ph(i,t,e){return(1-e)*i+e*t}function zp(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function yu(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function xv(i,t){if(t.constructor===Float32Array)return i;let e=yu(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/e,-1)}function vv(i,t){if(t.constructor===Float32Array)return i;let e=yu(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*e)}var Et=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Vt(this.x,t.x,e.x),this.y=Vt(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=Vt(this.x,t,e),this.y=Vt(this.y,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Vt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(Vt(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Gn=class{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],p=r[o+2],b=r[o+3];if(u!==b||l!==d||c!==f||h!==p){let m=l*d+c*f+h*p+u*b;m<0&&(d=-d,f=-f,p=-p,b=-b,m=-m);let g=1-a;if(m<.9995){let w=Math.acos(m),S=Math.sin(w);g=Math.sin(g*w)/S,a=Math.sin(a*w)/S,l=l*g+d*a,c=c*g+f*a,h=h*g+p*a,u=u*g+b*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+p*a,u=u*g+b*a;let w=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=w,c*=w,h*=w,u*=w}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],p=r[o+3];return t[e]=a*p+h*u+l*f-c*d,t[e+1]=l*p+h*d+c*u-a*f,t[e+2]=c*p+h*f+a*d-l*u,t[e+3]=h*p-a*u-l*d-c*f,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),p=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"YXZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"ZXY":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"ZYX":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"YZX":this._x=d*h*u+c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u-d*f*p;break;case"XZY":this._x=d*h*u-c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u+d*f*p;break;default:It("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<1e-8?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Vt(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},P=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,n=0){this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(If.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(If.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),h=2*(a*e-r*s),u=2*(r*n-o*e);return this.x=e+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Vt(this.x,t.x,e.x),this.y=Vt(this.y,t.y,e.y),this.z=Vt(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=Vt(this.x,t,e),this.y=Vt(this.y,t,e),this.z=Vt(this.z,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Vt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return mh.copy(this).projectOnVector(t),this.sub(mh)}reflect(t){return this.sub(mh.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(Vt(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},mh=new P,If=new Gn,Dt=class{static{this.prototype.isMatrix3=!0}constructor(t,e,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){let h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],p=n[8],b=s[0],m=s[3],g=s[6],w=s[1],S=s[4],x=s[7],_=s[2],A=s[5],v=s[8];return r[0]=o*b+a*w+l*_,r[3]=o*m+a*S+l*A,r[6]=o*g+a*x+l*v,r[1]=c*b+h*w+u*_,r[4]=c*m+h*S+u*A,r[7]=c*g+h*x+u*v,r[2]=d*b+f*w+p*_,r[5]=d*m+f*S+p*A,r[8]=d*g+f*x+p*v,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,p=e*u+n*d+s*f;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let b=1/p;return t[0]=u*b,t[1]=(s*c-h*n)*b,t[2]=(a*n-s*o)*b,t[3]=d*b,t[4]=(h*e-s*l)*b,t[5]=(s*r-a*e)*b,t[6]=f*b,t[7]=(n*l-c*e)*b,t[8]=(o*e-n*r)*b,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return Nr("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(gh.makeScale(t,e)),this}rotate(t){return Nr("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(gh.makeRotation(-t)),this}translate(t,e){return Nr("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(gh.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}},gh=new Dt,kf=new Dt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Nf=new Dt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function yv(){let i={enabled:!0,workingColorSpace:Or,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===re&&(s.r=Mi(s.r),s.g=Mi(s.g),s.b=Mi(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===re&&(s.r=Hs(s.r),s.g=Hs(s.g),s.b=Hs(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ri?Fr:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[Or]:{primaries:t,whitePoint:n,transfer:Fr,toXYZ:kf,fromXYZ:Nf,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:Cn},outputColorSpaceConfig:{drawingBufferColorSpace:Cn}},[Cn]:{primaries:t,whitePoint:n,transfer:re,toXYZ:kf,fromXYZ:Nf,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:Cn}}}),i}var $t=yv();function Mi(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Hs(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var As,La=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let n;if(t instanceof HTMLCanvasElement)n=t;else{As===void 0&&(As=Br("canvas")),As.width=t.width,As.height=t.height;let s=As.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),n=As}return n.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=Br("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Mi(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(Mi(e[n]/255)*255):e[n]=Mi(e[n]);return{data:e,width:t.width,height:t.height}}else return It("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},bv=0,$s=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:bv++}),this.uuid=ho(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(xh(s[o].image)):r.push(xh(s[o]))}else r=xh(s);n.url=r}return e||(t.images[this.uuid]=n),n}};function xh(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?La.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(It("Texture: Unable to serialize Texture."),{})}var wv=0,vh=new P,Sn=class i extends li{constructor(t=i.DEFAULT_IMAGE,e=i.DEFAULT_MAPPING,n=oi,s=oi,r=Xe,o=Ci,a=je,l=en,c=i.DEFAULT_ANISOTROPY,h=Ri){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:wv++}),this.uuid=ho(),this.name="",this.source=new $s(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Et(0,0),this.repeat=new Et(1,1),this.center=new Et(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Dt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(vh).x}get height(){return this.source.getSize(vh).y}get depth(){return this.source.getSize(vh).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let n=t[e];if(n===void 0){It(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){It(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==ru)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Aa:t.x=t.x-Math.floor(t.x);break;case oi:t.x=t.x<0?0:1;break;case Ca:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Aa:t.y=t.y-Math.floor(t.y);break;case oi:t.y=t.y<0?0:1;break;case Ca:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};Sn.DEFAULT_IMAGE=null;Sn.DEFAULT_MAPPING=ru;Sn.DEFAULT_ANISOTROPY=1;var Wt=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,n=0,s=1){this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r,l=t.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],p=l[9],b=l[2],m=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-b)<.01&&Math.abs(p-m)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+b)<.1&&Math.abs(p+m)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let S=(c+1)/2,x=(f+1)/2,_=(g+1)/2,A=(h+d)/4,v=(u+b)/4,M=(p+m)/4;return S>x&&S>_?S<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(S),s=A/n,r=v/n):x>_?x<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(x),n=A/s,r=M/s):_<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(_),n=v/r,s=M/r),this.set(n,s,r,e),this}let w=Math.sqrt((m-p)*(m-p)+(u-b)*(u-b)+(d-h)*(d-h));return Math.abs(w)<.001&&(w=1),this.x=(m-p)/w,this.y=(u-b)/w,this.z=(d-h)/w,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Vt(this.x,t.x,e.x),this.y=Vt(this.y,t.y,e.y),this.z=Vt(this.z,t.z,e.z),this.w=Vt(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=Vt(this.x,t,e),this.y=Vt(this.y,t,e),this.z=Vt(this.z,t,e),this.w=Vt(this.w,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Vt(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Ia=class extends li{constructor(t=1,e=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Xe,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=n.depth,this.scissor=new Wt(0,0,t,e),this.scissorTest=!1,this.viewport=new Wt(0,0,t,e),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Sn({width:t,height:e,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Xe,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,n=t.textures.length;e<n;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new $s(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Re=class extends Ia{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},zr=class extends Sn{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Se,this.minFilter=Se,this.wrapR=oi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var ka=class extends Sn{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Se,this.minFilter=Se,this.wrapR=oi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var Mt=class i{static{this.prototype.isMatrix4=!0}constructor(t,e,n,s,r,o,a,l,c,h,u,d,f,p,b,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,h,u,d,f,p,b,m)}set(t,e,n,s,r,o,a,l,c,h,u,d,f,p,b,m){let g=this.elements;return g[0]=t,g[4]=e,g[8]=n,g[12]=s,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=p,g[11]=b,g[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),n.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,n=t.elements,s=1/Cs.setFromMatrixColumn(t,0).length(),r=1/Cs.setFromMatrixColumn(t,1).length(),o=1/Cs.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let d=o*h,f=o*u,p=a*h,b=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=f+p*c,e[5]=d-b*c,e[9]=-a*l,e[2]=b-d*c,e[6]=p+f*c,e[10]=o*l}else if(t.order==="YXZ"){let d=l*h,f=l*u,p=c*h,b=c*u;e[0]=d+b*a,e[4]=p*a-f,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=f*a-p,e[6]=b+d*a,e[10]=o*l}else if(t.order==="ZXY"){let d=l*h,f=l*u,p=c*h,b=c*u;e[0]=d-b*a,e[4]=-o*u,e[8]=p+f*a,e[1]=f+p*a,e[5]=o*h,e[9]=b-d*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let d=o*h,f=o*u,p=a*h,b=a*u;e[0]=l*h,e[4]=p*c-f,e[8]=d*c+b,e[1]=l*u,e[5]=b*c+d,e[9]=f*c-p,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let d=o*l,f=o*c,p=a*l,b=a*c;e[0]=l*h,e[4]=b-d*u,e[8]=p*u+f,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=f*u+p,e[10]=d-b*u}else if(t.order==="XZY"){let d=o*l,f=o*c,p=a*l,b=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=d*u+b,e[5]=o*h,e[9]=f*u-p,e[2]=p*u-f,e[6]=a*h,e[10]=b*u+d}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(_v,t,Sv)}lookAt(t,e,n){let s=this.elements;return En.subVectors(t,e),En.lengthSq()===0&&(En.z=1),En.normalize(),Fi.crossVectors(n,En),Fi.lengthSq()===0&&(Math.abs(n.z)===1?En.x+=1e-4:En.z+=1e-4,En.normalize(),Fi.crossVectors(n,En)),Fi.normalize(),qo.crossVectors(En,Fi),s[0]=Fi.x,s[4]=qo.x,s[8]=En.x,s[1]=Fi.y,s[5]=qo.y,s[9]=En.y,s[2]=Fi.z,s[6]=qo.z,s[10]=En.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],p=n[2],b=n[6],m=n[10],g=n[14],w=n[3],S=n[7],x=n[11],_=n[15],A=s[0],v=s[4],M=s[8],N=s[12],C=s[1],L=s[5],I=s[9],F=s[13],k=s[2],B=s[6],G=s[10],W=s[14],et=s[3],X=s[7],Q=s[11],tt=s[15];return r[0]=o*A+a*C+l*k+c*et,r[4]=o*v+a*L+l*B+c*X,r[8]=o*M+a*I+l*G+c*Q,r[12]=o*N+a*F+l*W+c*tt,r[1]=h*A+u*C+d*k+f*et,r[5]=h*v+u*L+d*B+f*X,r[9]=h*M+u*I+d*G+f*Q,r[13]=h*N+u*F+d*W+f*tt,r[2]=p*A+b*C+m*k+g*et,r[6]=p*v+b*L+m*B+g*X,r[10]=p*M+b*I+m*G+g*Q,r[14]=p*N+b*F+m*W+g*tt,r[3]=w*A+S*C+x*k+_*et,r[7]=w*v+S*L+x*B+_*X,r[11]=w*M+S*I+x*G+_*Q,r[15]=w*N+S*F+x*W+_*tt,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],d=t[10],f=t[14],p=t[3],b=t[7],m=t[11],g=t[15],w=l*f-c*d,S=a*f-c*u,x=a*d-l*u,_=o*f-c*h,A=o*d-l*h,v=o*u-a*h;return e*(b*w-m*S+g*x)-n*(p*w-m*_+g*A)+s*(p*S-b*_+g*v)-r*(p*x-b*A+m*v)}determinantAffine(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],h=t[10];return e*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],d=t[10],f=t[11],p=t[12],b=t[13],m=t[14],g=t[15],w=e*a-n*o,S=e*l-s*o,x=e*c-r*o,_=n*l-s*a,A=n*c-r*a,v=s*c-r*l,M=h*b-u*p,N=h*m-d*p,C=h*g-f*p,L=u*m-d*b,I=u*g-f*b,F=d*g-f*m,k=w*F-S*I+x*L+_*C-A*N+v*M;if(k===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let B=1/k;return t[0]=(a*F-l*I+c*L)*B,t[1]=(s*I-n*F-r*L)*B,t[2]=(b*v-m*A+g*_)*B,t[3]=(d*A-u*v-f*_)*B,t[4]=(l*C-o*F-c*N)*B,t[5]=(e*F-s*C+r*N)*B,t[6]=(m*x-p*v-g*S)*B,t[7]=(h*v-d*x+f*S)*B,t[8]=(o*I-a*C+c*M)*B,t[9]=(n*C-e*I-r*M)*B,t[10]=(p*A-b*x+g*w)*B,t[11]=(u*x-h*A-f*w)*B,t[12]=(a*N-o*L-l*M)*B,t[13]=(e*L-n*N+s*M)*B,t[14]=(b*S-p*_-m*w)*B,t[15]=(h*_-u*S+d*w)*B,this}scale(t){let e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){let s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,p=r*u,b=o*h,m=o*u,g=a*u,w=l*c,S=l*h,x=l*u,_=n.x,A=n.y,v=n.z;return s[0]=(1-(b+g))*_,s[1]=(f+x)*_,s[2]=(p-S)*_,s[3]=0,s[4]=(f-x)*A,s[5]=(1-(d+g))*A,s[6]=(m+w)*A,s[7]=0,s[8]=(p+S)*v,s[9]=(m-w)*v,s[10]=(1-(d+b))*v,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),e.identity(),this;let o=Cs.set(s[0],s[1],s[2]).length(),a=Cs.set(s[4],s[5],s[6]).length(),l=Cs.set(s[8],s[9],s[10]).length();r<0&&(o=-o),qn.copy(this);let c=1/o,h=1/a,u=1/l;return qn.elements[0]*=c,qn.elements[1]*=c,qn.elements[2]*=c,qn.elements[4]*=h,qn.elements[5]*=h,qn.elements[6]*=h,qn.elements[8]*=u,qn.elements[9]*=u,qn.elements[10]*=u,e.setFromRotationMatrix(qn),n.x=o,n.y=a,n.z=l,this}makePerspective(t,e,n,s,r,o,a=Hn,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(n-s),d=(e+t)/(e-t),f=(n+s)/(n-s),p,b;if(l)p=r/(o-r),b=o*r/(o-r);else if(a===Hn)p=-(o+r)/(o-r),b=-2*o*r/(o-r);else if(a===Ur)p=-o/(o-r),b=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=b,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=Hn,l=!1){let c=this.elements,h=2/(e-t),u=2/(n-s),d=-(e+t)/(e-t),f=-(n+s)/(n-s),p,b;if(l)p=1/(o-r),b=o/(o-r);else if(a===Hn)p=-2/(o-r),b=-(o+r)/(o-r);else if(a===Ur)p=-1/(o-r),b=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=p,c[14]=b,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}},Cs=new P,qn=new Mt,_v=new P(0,0,0),Sv=new P(1,1,1),Fi=new P,qo=new P,En=new P,Df=new Mt,Of=new Gn,Hi=class i{constructor(t=0,e=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(e){case"XYZ":this._y=Math.asin(Vt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Vt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Vt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Vt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Vt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-Vt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:It("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return Df.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Df,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Of.setFromEuler(this),this.setFromQuaternion(Of,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Hi.DEFAULT_ORDER="XYZ";var Xs=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},Mv=0,Ff=new P,Ps=new Gn,yi=new Mt,Yo=new P,Rr=new P,Tv=new P,Ev=new Gn,Uf=new P(1,0,0),Bf=new P(0,1,0),zf=new P(0,0,1),Vf={type:"added"},Av={type:"removed"},Rs={type:"childadded",child:null},yh={type:"childremoved",child:null},Ln=class i extends li{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Mv++}),this.uuid=ho(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let t=new P,e=new Hi,n=new Gn,s=new P(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Mt},normalMatrix:{value:new Dt}}),this.matrix=new Mt,this.matrixWorld=new Mt,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Xs,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return Ps.setFromAxisAngle(t,e),this.quaternion.multiply(Ps),this}rotateOnWorldAxis(t,e){return Ps.setFromAxisAngle(t,e),this.quaternion.premultiply(Ps),this}rotateX(t){return this.rotateOnAxis(Uf,t)}rotateY(t){return this.rotateOnAxis(Bf,t)}rotateZ(t){return this.rotateOnAxis(zf,t)}translateOnAxis(t,e){return Ff.copy(t).applyQuaternion(this.quaternion),this.position.add(Ff.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Uf,t)}translateY(t){return this.translateOnAxis(Bf,t)}translateZ(t){return this.translateOnAxis(zf,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(yi.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?Yo.copy(t):Yo.set(t,e,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Rr.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?yi.lookAt(Rr,Yo,this.up):yi.lookAt(Yo,Rr,this.up),this.quaternion.setFromRotationMatrix(yi),s&&(yi.extractRotation(s.matrixWorld),Ps.setFromRotationMatrix(yi),this.quaternion.premultiply(Ps.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(kt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Vf),Rs.child=t,this.dispatchEvent(Rs),Rs.child=null):kt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(Av),yh.child=t,this.dispatchEvent(yh),yh.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),yi.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),yi.multiply(t.parent.matrixWorld)),t.applyMatrix4(yi),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Vf),Rs.child=t,this.dispatchEvent(Rs),Rs.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Rr,t,Tv),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Rr,Ev,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,n=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*n-r[8]*s,r[13]+=n-r[1]*e-r[5]*n-r[9]*s,r[14]+=s-r[2]*e-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e,n=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),d=o(t.skeletons),f=o(t.animations),p=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),p.length>0&&(n.nodes=p)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let s=t.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Ln.DEFAULT_UP=new P(0,1,0);Ln.DEFAULT_MATRIX_AUTO_UPDATE=!0;Ln.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var ai=class extends Ln{constructor(){super(),this.isGroup=!0,this.type="Group"}},Cv={type:"move"},qs=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new ai,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new ai,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new P,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new P),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new ai,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new P,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new P,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let b of t.hand.values()){let m=e.getJointPose(b,n),g=this._getHandJoint(c,b);m!==null&&(g.matrix.fromArray(m.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=m.radius),g.visible=m!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,p=.005;c.inputState.pinching&&d>f+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&d<=f-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Cv)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new ai;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},Vp={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Ui={h:0,s:0,l:0},Zo={h:0,s:0,l:0};function bh(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}var Ot=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=Cn){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,$t.colorSpaceToWorking(this,e),this}setRGB(t,e,n,s=$t.workingColorSpace){return this.r=t,this.g=e,this.b=n,$t.colorSpaceToWorking(this,s),this}setHSL(t,e,n,s=$t.workingColorSpace){if(t=gv(t,1),e=Vt(e,0,1),n=Vt(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=bh(o,r,t+1/3),this.g=bh(o,r,t),this.b=bh(o,r,t-1/3)}return $t.colorSpaceToWorking(this,s),this}setStyle(t,e=Cn){function n(r){r!==void 0&&parseFloat(r)<1&&It("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:It("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);It("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=Cn){let n=Vp[t.toLowerCase()];return n!==void 0?this.setHex(n,e):It("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=Mi(t.r),this.g=Mi(t.g),this.b=Mi(t.b),this}copyLinearToSRGB(t){return this.r=Hs(t.r),this.g=Hs(t.g),this.b=Hs(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=Cn){return $t.workingToColorSpace(an.copy(this),t),Math.round(Vt(an.r*255,0,255))*65536+Math.round(Vt(an.g*255,0,255))*256+Math.round(Vt(an.b*255,0,255))}getHexString(t=Cn){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=$t.workingColorSpace){$t.workingToColorSpace(an.copy(this),e);let n=an.r,s=an.g,r=an.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=$t.workingColorSpace){return $t.workingToColorSpace(an.copy(this),e),t.r=an.r,t.g=an.g,t.b=an.b,t}getStyle(t=Cn){$t.workingToColorSpace(an.copy(this),t);let e=an.r,n=an.g,s=an.b;return t!==Cn?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(Ui),this.setHSL(Ui.h+t,Ui.s+e,Ui.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(Ui),t.getHSL(Zo);let n=ph(Ui.h,Zo.h,e),s=ph(Ui.s,Zo.s,e),r=ph(Ui.l,Zo.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},an=new Ot;Ot.NAMES=Vp;var ci=class extends Ln{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Hi,this.environmentIntensity=1,this.environmentRotation=new Hi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},Yn=new P,bi=new P,wh=new P,wi=new P,Ls=new P,Is=new P,Hf=new P,_h=new P,Sh=new P,Mh=new P,Th=new Wt,Eh=new Wt,Ah=new Wt,cn=class i{constructor(t=new P,e=new P,n=new P){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),Yn.subVectors(t,e),s.cross(Yn);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){Yn.subVectors(s,e),bi.subVectors(n,e),wh.subVectors(t,e);let o=Yn.dot(Yn),a=Yn.dot(bi),l=Yn.dot(wh),c=bi.dot(bi),h=bi.dot(wh),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,p=(o*h-a*l)*d;return r.set(1-f-p,p,f)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,wi)===null?!1:wi.x>=0&&wi.y>=0&&wi.x+wi.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,wi)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,wi.x),l.addScaledVector(o,wi.y),l.addScaledVector(a,wi.z),l)}static getInterpolatedAttribute(t,e,n,s,r,o){return Th.setScalar(0),Eh.setScalar(0),Ah.setScalar(0),Th.fromBufferAttribute(t,e),Eh.fromBufferAttribute(t,n),Ah.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Th,r.x),o.addScaledVector(Eh,r.y),o.addScaledVector(Ah,r.z),o}static isFrontFacing(t,e,n,s){return Yn.subVectors(n,e),bi.subVectors(t,e),Yn.cross(bi).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return Yn.subVectors(this.c,this.b),bi.subVectors(this.a,this.b),Yn.cross(bi).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return i.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return i.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return i.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return i.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return i.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,s=this.b,r=this.c,o,a;Ls.subVectors(s,n),Is.subVectors(r,n),_h.subVectors(t,n);let l=Ls.dot(_h),c=Is.dot(_h);if(l<=0&&c<=0)return e.copy(n);Sh.subVectors(t,s);let h=Ls.dot(Sh),u=Is.dot(Sh);if(h>=0&&u<=h)return e.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),e.copy(n).addScaledVector(Ls,o);Mh.subVectors(t,r);let f=Ls.dot(Mh),p=Is.dot(Mh);if(p>=0&&f<=p)return e.copy(r);let b=f*c-l*p;if(b<=0&&c>=0&&p<=0)return a=c/(c-p),e.copy(n).addScaledVector(Is,a);let m=h*p-f*u;if(m<=0&&u-h>=0&&f-p>=0)return Hf.subVectors(r,s),a=(u-h)/(u-h+(f-p)),e.copy(s).addScaledVector(Hf,a);let g=1/(m+b+d);return o=b*g,a=d*g,e.copy(n).addScaledVector(Ls,o).addScaledVector(Is,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},le=class{constructor(t=new P(1/0,1/0,1/0),e=new P(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(Zn.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(Zn.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=Zn.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,Zn):Zn.fromBufferAttribute(r,o),Zn.applyMatrix4(t.matrixWorld),this.expandByPoint(Zn);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Jo.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),Jo.copy(n.boundingBox)),Jo.applyMatrix4(t.matrixWorld),this.union(Jo)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,Zn),Zn.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(Lr),Ko.subVectors(this.max,Lr),ks.subVectors(t.a,Lr),Ns.subVectors(t.b,Lr),Ds.subVectors(t.c,Lr),Bi.subVectors(Ns,ks),zi.subVectors(Ds,Ns),ls.subVectors(ks,Ds);let e=[0,-Bi.z,Bi.y,0,-zi.z,zi.y,0,-ls.z,ls.y,Bi.z,0,-Bi.x,zi.z,0,-zi.x,ls.z,0,-ls.x,-Bi.y,Bi.x,0,-zi.y,zi.x,0,-ls.y,ls.x,0];return!Ch(e,ks,Ns,Ds,Ko)||(e=[1,0,0,0,1,0,0,0,1],!Ch(e,ks,Ns,Ds,Ko))?!1:(jo.crossVectors(Bi,zi),e=[jo.x,jo.y,jo.z],Ch(e,ks,Ns,Ds,Ko))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,Zn).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(Zn).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(_i[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),_i[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),_i[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),_i[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),_i[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),_i[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),_i[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),_i[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(_i),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},_i=[new P,new P,new P,new P,new P,new P,new P,new P],Zn=new P,Jo=new le,ks=new P,Ns=new P,Ds=new P,Bi=new P,zi=new P,ls=new P,Lr=new P,Ko=new P,jo=new P,cs=new P;function Ch(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){cs.fromArray(i,r);let a=s.x*Math.abs(cs.x)+s.y*Math.abs(cs.y)+s.z*Math.abs(cs.z),l=t.dot(cs),c=e.dot(cs),h=n.dot(cs);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Pe=new P,Qo=new Et,Pv=0,be=class extends li{constructor(t,e,n=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:Pv++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=Dp,this.updateRanges=[],this.gpuType=Rn,this.version=0,this._normalizationScale=t!==void 0?yu(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)Qo.fromBufferAttribute(this,e),Qo.applyMatrix3(t),this.setXY(e,Qo.x,Qo.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)Pe.fromBufferAttribute(this,e),Pe.applyMatrix3(t),this.setXYZ(e,Pe.x,Pe.y,Pe.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)Pe.fromBufferAttribute(this,e),Pe.applyMatrix4(t),this.setXYZ(e,Pe.x,Pe.y,Pe.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Pe.fromBufferAttribute(this,e),Pe.applyNormalMatrix(t),this.setXYZ(e,Pe.x,Pe.y,Pe.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Pe.fromBufferAttribute(this,e),Pe.transformDirection(t),this.setXYZ(e,Pe.x,Pe.y,Pe.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):xv(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):vv(t,this.array)}};var Vr=class extends be{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var Hr=class extends be{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var $e=class extends be{constructor(t,e,n){super(new Float32Array(t),e,n)}},Rv=new le,Ir=new P,Ph=new P,Pn=class{constructor(t=new P,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):Rv.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;Ir.subVectors(t,this.center);let e=Ir.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(Ir,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Ph.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(Ir.copy(t.center).add(Ph)),this.expandByPoint(Ir.copy(t.center).sub(Ph))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},Lv=0,Vn=new Mt,Rh=new Ln,Os=new P,An=new le,kr=new le,We=new P,Le=class i extends li{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Lv++}),this.uuid=ho(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(pv(t)?Hr:Vr)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new Dt().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return Vn.makeRotationFromQuaternion(t),this.applyMatrix4(Vn),this}rotateX(t){return Vn.makeRotationX(t),this.applyMatrix4(Vn),this}rotateY(t){return Vn.makeRotationY(t),this.applyMatrix4(Vn),this}rotateZ(t){return Vn.makeRotationZ(t),this.applyMatrix4(Vn),this}translate(t,e,n){return Vn.makeTranslation(t,e,n),this.applyMatrix4(Vn),this}scale(t,e,n){return Vn.makeScale(t,e,n),this.applyMatrix4(Vn),this}lookAt(t){return Rh.lookAt(t),Rh.updateMatrix(),this.applyMatrix4(Rh.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Os).negate(),this.translate(Os.x,Os.y,Os.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let n=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new $e(n,3))}else{let n=Math.min(t.length,e.count);for(let s=0;s<n;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&It("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new le);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){kt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new P(-1/0,-1/0,-1/0),new P(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){let r=e[n];An.setFromBufferAttribute(r),this.morphTargetsRelative?(We.addVectors(this.boundingBox.min,An.min),this.boundingBox.expandByPoint(We),We.addVectors(this.boundingBox.max,An.max),this.boundingBox.expandByPoint(We)):(this.boundingBox.expandByPoint(An.min),this.boundingBox.expandByPoint(An.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&kt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Pn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){kt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new P,1/0);return}if(t){let n=this.boundingSphere.center;if(An.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];kr.setFromBufferAttribute(a),this.morphTargetsRelative?(We.addVectors(An.min,kr.min),An.expandByPoint(We),We.addVectors(An.max,kr.max),An.expandByPoint(We)):(An.expandByPoint(kr.min),An.expandByPoint(kr.max))}An.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)We.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(We));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)We.fromBufferAttribute(a,c),l&&(Os.fromBufferAttribute(t,c),We.add(Os)),s=Math.max(s,n.distanceToSquared(We))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&kt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){kt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new be(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let N=0;N<n.count;N++)a[N]=new P,l[N]=new P;let h=new P,u=new P,d=new P,f=new Et,p=new Et,b=new Et,m=new P,g=new P;function w(N,C,L){c[N]=c[C]=c[L]=1,h.fromBufferAttribute(n,N),u.fromBufferAttribute(n,C),d.fromBufferAttribute(n,L),f.fromBufferAttribute(r,N),p.fromBufferAttribute(r,C),b.fromBufferAttribute(r,L),u.sub(h),d.sub(h),p.sub(f),b.sub(f);let I=1/(p.x*b.y-b.x*p.y);isFinite(I)&&(m.copy(u).multiplyScalar(b.y).addScaledVector(d,-p.y).multiplyScalar(I),g.copy(d).multiplyScalar(p.x).addScaledVector(u,-b.x).multiplyScalar(I),a[N].add(m),a[C].add(m),a[L].add(m),l[N].add(g),l[C].add(g),l[L].add(g))}let S=this.groups;S.length===0&&(S=[{start:0,count:t.count}]);for(let N=0,C=S.length;N<C;++N){let L=S[N],I=L.start,F=L.count;for(let k=I,B=I+F;k<B;k+=3)w(t.getX(k+0),t.getX(k+1),t.getX(k+2))}let x=new P,_=new P,A=new P,v=new P;function M(N){A.fromBufferAttribute(s,N),v.copy(A);let C=a[N];x.copy(C),x.sub(A.multiplyScalar(A.dot(C))).normalize(),_.crossVectors(v,C);let I=_.dot(l[N])<0?-1:1;o.setXYZW(N,x.x,x.y,x.z,I)}for(let N=0,C=n.count;N<C;++N)c[N]&&M(N);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==e.count)n=new be(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new P,r=new P,o=new P,a=new P,l=new P,c=new P,h=new P,u=new P;if(t)for(let d=0,f=t.count;d<f;d+=3){let p=t.getX(d+0),b=t.getX(d+1),m=t.getX(d+2);s.fromBufferAttribute(e,p),r.fromBufferAttribute(e,b),o.fromBufferAttribute(e,m),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,p),l.fromBufferAttribute(n,b),c.fromBufferAttribute(n,m),a.add(h),l.add(h),c.add(h),n.setXYZ(p,a.x,a.y,a.z),n.setXYZ(b,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let d=0,f=e.count;d<f;d+=3)s.fromBufferAttribute(e,d+0),r.fromBufferAttribute(e,d+1),o.fromBufferAttribute(e,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)We.fromBufferAttribute(t,e),We.normalize(),t.setXYZ(e,We.x,We.y,We.z)}toNonIndexed(){function t(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,p=0;for(let b=0,m=l.length;b<m;b++){a.isInterleavedBufferAttribute?f=l[b]*a.data.stride+a.offset:f=l[b]*h;for(let g=0;g<h;g++)d[p++]=c[f++]}return new be(d,h,u)}if(this.index===null)return It("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=t(l,n);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=t(d,n);l.push(f)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone());let s=t.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Lh=new P,Iv=new P,kv=new Dt,pn=class{constructor(t=new P(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let s=Lh.subVectors(n,e).cross(Iv.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,n=!0){let s=t.delta(Lh),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||kv.getNormalMatrix(t),s=this.coplanarPoint(Lh).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},Nv=0,Gi=class extends li{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Nv++}),this.uuid=ho(),this.name="",this.type="Material",this.blending=js,this.side=jn,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=eo,this.blendDst=Qs,this.blendEquation=fs,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Ot(0,0,0),this.blendAlpha=0,this.depthFunc=Gs,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Pp,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=ya,this.stencilZFail=ya,this.stencilZPass=ya,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){It(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){It(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Ot().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(n=>new pn().fromJSON(n))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let n=t.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new Et().fromArray(n)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Et().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var Si=new P,Ih=new P,ta=new P,ea=new P,Wi=class{constructor(t=new P,e=new P(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Si)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=Si.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Si.copy(this.origin).addScaledVector(this.direction,e),Si.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){Ih.copy(t).add(e).multiplyScalar(.5),ta.copy(e).sub(t).normalize(),ea.copy(this.origin).sub(Ih);let r=t.distanceTo(e)*.5,o=-this.direction.dot(ta),a=ea.dot(this.direction),l=-ea.dot(ta),c=ea.lengthSq(),h=Math.abs(1-o*o),u,d,f,p;if(h>0)if(u=o*l-a,d=o*a-l,p=r*h,u>=0)if(d>=-p)if(d<=p){let b=1/h;u*=b,d*=b,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-p?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=p?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Ih).addScaledVector(ta,d),f}intersectSphere(t,e){if(t.radius<0)return null;Si.subVectors(t.center,this.origin);let n=Si.dot(this.direction),s=Si.dot(Si)-n*n,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(t.min.x-d.x)*c,s=(t.max.x-d.x)*c):(n=(t.max.x-d.x)*c,s=(t.min.x-d.x)*c),h>=0?(r=(t.min.y-d.y)*h,o=(t.max.y-d.y)*h):(r=(t.max.y-d.y)*h,o=(t.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-d.z)*u,l=(t.max.z-d.z)*u):(a=(t.max.z-d.z)*u,l=(t.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,Si)!==null}intersectTriangle(t,e,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=t.x-o.x,d=t.y-o.y,f=t.z-o.z,p=e.x-o.x,b=e.y-o.y,m=e.z-o.z,g=n.x-o.x,w=n.y-o.y,S=n.z-o.z,x=Math.abs(l),_=Math.abs(c),A=Math.abs(h),v,M,N,C,L,I,F,k,B,G,W,et;if(x>=_&&x>=A?(N=l,I=u,B=p,et=g,l>=0?(v=c,M=h,C=d,L=f,F=b,k=m,G=w,W=S):(v=h,M=c,C=f,L=d,F=m,k=b,G=S,W=w)):_>=A?(N=c,I=d,B=b,et=w,c>=0?(v=h,M=l,C=f,L=u,F=m,k=p,G=S,W=g):(v=l,M=h,C=u,L=f,F=p,k=m,G=g,W=S)):(N=h,I=f,B=m,et=S,h>=0?(v=l,M=c,C=u,L=d,F=p,k=b,G=g,W=w):(v=c,M=l,C=d,L=u,F=b,k=p,G=w,W=g)),N===0)return null;let X=v/N,Q=M/N,tt=1/N,yt=C-X*I,Nt=L-Q*I,J=F-X*B,ht=k-Q*B,vt=G-X*et,Ct=W-Q*et,pt=vt*ht-Ct*J,Ft=yt*Ct-Nt*vt,Te=J*Nt-ht*yt;if(s){if(pt<0||Ft<0||Te<0)return null}else if((pt<0||Ft<0||Te<0)&&(pt>0||Ft>0||Te>0))return null;let Pt=pt+Ft+Te;if(Pt===0)return null;let jt=tt*(pt*I+Ft*B+Te*et);return(Pt>0?jt<0:jt>0)?null:this.at(jt/Pt,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Na=class extends Gi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Ot(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Hi,this.combine=Kh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Gf=new Mt,hs=new Wi,na=new Pn,Wf=new P,ia=new P,sa=new P,ra=new P,kh=new P,oa=new P,$f=new P,aa=new P,Ie=class extends Ln{constructor(t=new Le,e=new Na){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){oa.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(kh.fromBufferAttribute(u,t),o?oa.addScaledVector(kh,h):oa.addScaledVector(kh.sub(e),h))}e.add(oa)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),na.copy(n.boundingSphere),na.applyMatrix4(r),hs.copy(t.ray).recast(t.near),!(na.containsPoint(hs.origin)===!1&&(hs.intersectSphere(na,Wf)===null||hs.origin.distanceToSquared(Wf)>(t.far-t.near)**2))&&(Gf.copy(r).invert(),hs.copy(t.ray).applyMatrix4(Gf),!(n.boundingBox!==null&&hs.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,hs)))}_computeIntersections(t,e,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,b=d.length;p<b;p++){let m=d[p],g=o[m.materialIndex],w=Math.max(m.start,f.start),S=Math.min(a.count,Math.min(m.start+m.count,f.start+f.count));for(let x=w,_=S;x<_;x+=3){let A=a.getX(x),v=a.getX(x+1),M=a.getX(x+2);s=la(this,g,t,n,c,h,u,A,v,M),s&&(s.faceIndex=Math.floor(x/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let p=Math.max(0,f.start),b=Math.min(a.count,f.start+f.count);for(let m=p,g=b;m<g;m+=3){let w=a.getX(m),S=a.getX(m+1),x=a.getX(m+2);s=la(this,o,t,n,c,h,u,w,S,x),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let p=0,b=d.length;p<b;p++){let m=d[p],g=o[m.materialIndex],w=Math.max(m.start,f.start),S=Math.min(l.count,Math.min(m.start+m.count,f.start+f.count));for(let x=w,_=S;x<_;x+=3){let A=x,v=x+1,M=x+2;s=la(this,g,t,n,c,h,u,A,v,M),s&&(s.faceIndex=Math.floor(x/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let p=Math.max(0,f.start),b=Math.min(l.count,f.start+f.count);for(let m=p,g=b;m<g;m+=3){let w=m,S=m+1,x=m+2;s=la(this,o,t,n,c,h,u,w,S,x),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}}};function Dv(i,t,e,n,s,r,o,a){let l;if(t.side===tn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===jn,a),l===null)return null;aa.copy(a),aa.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(aa);return c<e.near||c>e.far?null:{distance:c,point:aa.clone(),object:i}}function la(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,ia),i.getVertexPosition(l,sa),i.getVertexPosition(c,ra);let h=Dv(i,t,e,n,ia,sa,ra,$f);if(h){let u=new P;cn.getBarycoord($f,ia,sa,ra,u),s&&(h.uv=cn.getInterpolatedAttribute(s,a,l,c,u,new Et)),r&&(h.uv1=cn.getInterpolatedAttribute(r,a,l,c,u,new Et)),o&&(h.normal=cn.getInterpolatedAttribute(o,a,l,c,u,new P),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new P,materialIndex:0};cn.getNormal(ia,sa,ra,d.normal),h.face=d,h.barycoord=u}return h}var Ti=class extends Sn{constructor(t=null,e=1,n=1,s,r,o,a,l,c=Se,h=Se,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Gr=class extends be{constructor(t,e,n,s=1){super(t,e,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){let t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}};var us=new Pn,Ov=new Et(.5,.5),ca=new P,hi=class{constructor(t=new pn,e=new pn,n=new pn,s=new pn,r=new pn,o=new pn){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=Hn,n=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],p=r[8],b=r[9],m=r[10],g=r[11],w=r[12],S=r[13],x=r[14],_=r[15];if(s[0].setComponents(c-o,f-h,g-p,_-w).normalize(),s[1].setComponents(c+o,f+h,g+p,_+w).normalize(),s[2].setComponents(c+a,f+u,g+b,_+S).normalize(),s[3].setComponents(c-a,f-u,g-b,_-S).normalize(),n)s[4].setComponents(l,d,m,x).normalize(),s[5].setComponents(c-l,f-d,g-m,_-x).normalize();else if(s[4].setComponents(c-l,f-d,g-m,_-x).normalize(),e===Hn)s[5].setComponents(c+l,f+d,g+m,_+x).normalize();else if(e===Ur)s[5].setComponents(l,d,m,x).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),us.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),us.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(us)}intersectsSprite(t){us.center.set(0,0,0);let e=Ov.distanceTo(t.center);return us.radius=.7071067811865476+e,us.applyMatrix4(t.matrixWorld),this.intersectsSphere(us)}intersectsSphere(t){let e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let s=e[n];if(ca.x=s.normal.x>0?t.max.x:t.min.x,ca.y=s.normal.y>0?t.max.y:t.min.y,ca.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(ca)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Xf=new Mt,Wr=class i{constructor(){this.coordinateSystem=Hn,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,n=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];Xf.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new hi),n[s].setFromProjectionMatrix(Xf,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,n=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new hi),e[s].copy(n[s]);return this._count=t._count,this}clone(){return new i().copy(this)}};function Nh(i,t){return i-t}function Fv(i,t){return i.z-t.z}function Uv(i,t){return t.z-i.z}var Hh=class{constructor(){this.index=0,this.pool=[],this.list=[]}push(t,e,n,s){let r=this.pool,o=this.list;this.index>=r.length&&r.push({start:-1,count:-1,z:-1,index:-1});let a=r[this.index];o.push(a),this.index++,a.start=t,a.count=e,a.z=n,a.index=s}reset(){this.list.length=0,this.index=0}},_n=new Mt,Bv=new Ot(1,1,1),zv=new hi,Vv=new Wr,ha=new le,ds=new Pn,Dh=new P,qf=new P,Yf=new P,Hv=new P,Oh=new Hh,ln=new Ie,ua=[];function Gv(i,t,e=0){let n=t.itemSize;if(i.isInterleavedBufferAttribute||i.array.constructor!==t.array.constructor){let s=i.count;for(let r=0;r<s;r++)for(let o=0;o<n;o++)t.setComponent(r+e,o,i.getComponent(r,o))}else t.array.set(i.array,e*n);t.needsUpdate=!0}function si(i,t){if(i.constructor!==t.constructor){let e=Math.min(i.length,t.length);for(let n=0;n<e;n++)t[n]=i[n]}else{let e=Math.min(i.length,t.length);t.set(new i.constructor(i.buffer,0,e))}}var $r=class extends Ie{constructor(t,e,n=e*2,s){super(new Le,s),this.isBatchedMesh=!0,this.perObjectFrustumCulled=!0,this.sortObjects=!0,this.boundingBox=null,this.boundingSphere=null,this.customSort=null,this._instanceInfo=[],this._geometryInfo=[],this._availableInstanceIds=[],this._availableGeometryIds=[],this._nextIndexStart=0,this._nextVertexStart=0,this._geometryCount=0,this._visibilityChanged=!0,this._geometryInitialized=!1,this._maxInstanceCount=t,this._maxVertexCount=e,this._maxIndexCount=n,this._multiDrawCounts=new Int32Array(t),this._multiDrawStarts=new Int32Array(t),this._multiDrawCount=0,this._multiDrawBytesPerElement=1,this._mergedDrawCounts=new Int32Array(t),this._mergedDrawStarts=new Int32Array(t),this._mergedDrawInstanceCounts=new Int32Array(t),this._mergedDrawCount=0,this._matricesTexture=null,this._indirectTexture=null,this._colorsTexture=null,this._previousMatricesTexture=null,this._initMatricesTexture(),this._initIndirectTexture()}get maxInstanceCount(){return this._maxInstanceCount}get instanceCount(){return this._instanceInfo.length-this._availableInstanceIds.length}get unusedVertexCount(){return this._maxVertexCount-this._nextVertexStart}get unusedIndexCount(){return this._maxIndexCount-this._nextIndexStart}_initMatricesTexture(){let t=Math.sqrt(this._maxInstanceCount*4);t=Math.ceil(t/4)*4,t=Math.max(t,4);let e=new Float32Array(t*t*4),n=new Ti(e,t,t,je,Rn);this._matricesTexture=n}_initIndirectTexture(){let t=Math.sqrt(this._maxInstanceCount);t=Math.ceil(t);let e=new Uint32Array(t*t),n=new Ti(e,t,t,io,Mn);this._indirectTexture=n}_initColorsTexture(){let t=Math.sqrt(this._maxInstanceCount);t=Math.ceil(t);let e=new Float32Array(t*t*4).fill(1),n=new Ti(e,t,t,je,Rn);n.colorSpace=$t.workingColorSpace,this._colorsTexture=n}_initializeGeometry(t){let e=this.geometry,n=this._maxVertexCount,s=this._maxIndexCount;if(this._geometryInitialized===!1){for(let r in t.attributes){let o=t.getAttribute(r),{array:a,itemSize:l,normalized:c}=o,h=new a.constructor(n*l),u=new be(h,l,c);e.setAttribute(r,u)}if(t.getIndex()!==null){let r=n>65535?new Uint32Array(s):new Uint16Array(s);e.setIndex(new be(r,1))}this._geometryInitialized=!0}}_validateGeometry(t){let e=this.geometry;if(!!t.getIndex()!=!!e.getIndex())throw new Error('THREE.BatchedMesh: All geometries must consistently have "index".');for(let n in e.attributes){if(!t.hasAttribute(n))throw new Error(`THREE.BatchedMesh: Added geometry missing "${n}". All geometries must have consistent attributes.`);let s=t.getAttribute(n),r=e.getAttribute(n);if(s.itemSize!==r.itemSize||s.normalized!==r.normalized)throw new Error(`THREE.BatchedMesh: Added geometry attribute "${n}" has an inconsistent itemSize or normalized value.`)}}validateInstanceId(t){let e=this._instanceInfo;if(t<0||t>=e.length||e[t].active===!1)throw new Error(`THREE.BatchedMesh: Invalid instanceId ${t}. Instance is either out of range or has been deleted.`)}validateGeometryId(t){let e=this._geometryInfo;if(t<0||t>=e.length||e[t].active===!1)throw new Error(`THREE.BatchedMesh: Invalid geometryId ${t}. Geometry is either out of range or has been deleted.`)}setCustomSort(t){return this.customSort=t,this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new le);let t=this.boundingBox,e=this._instanceInfo;t.makeEmpty();for(let n=0,s=e.length;n<s;n++){if(e[n].active===!1)continue;let r=e[n].geometryIndex;this.getMatrixAt(n,_n),this.getBoundingBoxAt(r,ha).applyMatrix4(_n),t.union(ha)}}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Pn);let t=this.boundingSphere,e=this._instanceInfo;t.makeEmpty();for(let n=0,s=e.length;n<s;n++){if(e[n].active===!1)continue;let r=e[n].geometryIndex;this.getMatrixAt(n,_n),this.getBoundingSphereAt(r,ds).applyMatrix4(_n),t.union(ds)}}addInstance(t){if(this._instanceInfo.length>=this.maxInstanceCount&&this._availableInstanceIds.length===0)throw new Error("THREE.BatchedMesh: Maximum item count reached.");let n={visible:!0,active:!0,geometryIndex:t},s=null;this._availableInstanceIds.length>0?(this._availableInstanceIds.sort(Nh),s=this._availableInstanceIds.shift(),this._instanceInfo[s]=n):(s=this._instanceInfo.length,this._instanceInfo.push(n));let r=this._matricesTexture;_n.identity().toArray(r.image.data,s*16),r.needsUpdate=!0;let o=this._colorsTexture;return o&&(Bv.toArray(o.image.data,s*4),o.needsUpdate=!0),this._visibilityChanged=!0,s}addGeometry(t,e=-1,n=-1){this._initializeGeometry(t),this._validateGeometry(t);let s={vertexStart:-1,vertexCount:-1,reservedVertexCount:-1,indexStart:-1,indexCount:-1,reservedIndexCount:-1,start:-1,count:-1,boundingBox:null,boundingSphere:null,active:!0},r=this._geometryInfo;s.vertexStart=this._nextVertexStart,s.reservedVertexCount=e===-1?t.getAttribute("position").count:e;let o=t.getIndex();if(o!==null&&(s.indexStart=this._nextIndexStart,s.reservedIndexCount=n===-1?o.count:n),s.indexStart!==-1&&s.indexStart+s.reservedIndexCount>this._maxIndexCount||s.vertexStart+s.reservedVertexCount>this._maxVertexCount)throw new Error("THREE.BatchedMesh: Reserved space request exceeds the maximum buffer size.");let l;return this._availableGeometryIds.length>0?(this._availableGeometryIds.sort(Nh),l=this._availableGeometryIds.shift(),r[l]=s):(l=this._geometryCount,this._geometryCount++,r.push(s)),this.setGeometryAt(l,t),this._nextIndexStart=s.indexStart+s.reservedIndexCount,this._nextVertexStart=s.vertexStart+s.reservedVertexCount,l}setGeometryAt(t,e){if(t>=this._geometryCount)throw new Error("THREE.BatchedMesh: Maximum geometry count reached.");this._validateGeometry(e);let n=this.geometry,s=n.getIndex()!==null,r=n.getIndex(),o=e.getIndex(),a=this._geometryInfo[t];if(s&&o.count>a.reservedIndexCount||e.attributes.position.count>a.reservedVertexCount)throw new Error("THREE.BatchedMesh: Reserved space not large enough for provided geometry.");let l=a.vertexStart,c=a.reservedVertexCount;a.vertexCount=e.getAttribute("position").count;for(let h in n.attributes){let u=e.getAttribute(h),d=n.getAttribute(h);Gv(u,d,l);let f=u.itemSize;for(let p=u.count,b=c;p<b;p++){let m=l+p;for(let g=0;g<f;g++)d.setComponent(m,g,0)}d.needsUpdate=!0,d.addUpdateRange(l*f,c*f)}if(s){let h=a.indexStart,u=a.reservedIndexCount;a.indexCount=e.getIndex().count;for(let d=0;d<o.count;d++)r.setX(h+d,l+o.getX(d));for(let d=o.count,f=u;d<f;d++)r.setX(h+d,l);r.needsUpdate=!0,r.addUpdateRange(h,a.reservedIndexCount)}return a.start=s?a.indexStart:a.vertexStart,a.count=s?a.indexCount:a.vertexCount,a.boundingBox=null,e.boundingBox!==null&&(a.boundingBox=e.boundingBox.clone()),a.boundingSphere=null,e.boundingSphere!==null&&(a.boundingSphere=e.boundingSphere.clone()),this._visibilityChanged=!0,t}deleteGeometry(t){let e=this._geometryInfo;if(t>=e.length||e[t].active===!1)return this;let n=this._instanceInfo;for(let s=0,r=n.length;s<r;s++)n[s].active&&n[s].geometryIndex===t&&this.deleteInstance(s);return e[t].active=!1,this._availableGeometryIds.push(t),this._visibilityChanged=!0,this}deleteInstance(t){return this.validateInstanceId(t),this._instanceInfo[t].active=!1,this._availableInstanceIds.push(t),this._visibilityChanged=!0,this}optimize(){let t=0,e=0,n=this._geometryInfo,s=n.map((o,a)=>a).sort((o,a)=>n[o].vertexStart-n[a].vertexStart),r=this.geometry;for(let o=0,a=n.length;o<a;o++){let l=s[o],c=n[l];if(c.active!==!1){if(r.index!==null){if(c.indexStart!==e){let{indexStart:h,vertexStart:u,reservedIndexCount:d}=c,f=r.index,p=f.array,b=t-u;for(let m=h;m<h+d;m++)p[m]=p[m]+b;f.array.copyWithin(e,h,h+d),f.addUpdateRange(e,d),f.needsUpdate=!0,c.indexStart=e}e+=c.reservedIndexCount}if(c.vertexStart!==t){let{vertexStart:h,reservedVertexCount:u}=c,d=r.attributes;for(let f in d){let p=d[f],{array:b,itemSize:m}=p;b.copyWithin(t*m,h*m,(h+u)*m),p.addUpdateRange(t*m,u*m),p.needsUpdate=!0}c.vertexStart=t}t+=c.reservedVertexCount,c.start=r.index?c.indexStart:c.vertexStart}}return this._nextIndexStart=e,this._nextVertexStart=t,this._visibilityChanged=!0,this}getBoundingBoxAt(t,e){if(t>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[t];if(s.boundingBox===null){let r=new le,o=n.index,a=n.attributes.position;for(let l=s.start,c=s.start+s.count;l<c;l++){let h=l;o&&(h=o.getX(h)),r.expandByPoint(Dh.fromBufferAttribute(a,h))}s.boundingBox=r}return e.copy(s.boundingBox),e}getBoundingSphereAt(t,e){if(t>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[t];if(s.boundingSphere===null){let r=new Pn;this.getBoundingBoxAt(t,ha),ha.getCenter(r.center);let o=n.index,a=n.attributes.position,l=0;for(let c=s.start,h=s.start+s.count;c<h;c++){let u=c;o&&(u=o.getX(u)),Dh.fromBufferAttribute(a,u),l=Math.max(l,r.center.distanceToSquared(Dh))}r.radius=Math.sqrt(l),s.boundingSphere=r}return e.copy(s.boundingSphere),e}setMatrixAt(t,e){this.validateInstanceId(t);let n=this._matricesTexture,s=this._matricesTexture.image.data;return e.toArray(s,t*16),n.needsUpdate=!0,this}getMatrixAt(t,e){return this.validateInstanceId(t),e.fromArray(this._matricesTexture.image.data,t*16)}setColorAt(t,e){return this.validateInstanceId(t),this._colorsTexture===null&&this._initColorsTexture(),e.toArray(this._colorsTexture.image.data,t*4),this._colorsTexture.needsUpdate=!0,this}getColorAt(t,e){return this.validateInstanceId(t),this._colorsTexture===null?e.isVector4?e.set(1,1,1,1):e.setRGB(1,1,1):e.fromArray(this._colorsTexture.image.data,t*4)}setVisibleAt(t,e){return this.validateInstanceId(t),this._instanceInfo[t].visible===e?this:(this._instanceInfo[t].visible=e,this._visibilityChanged=!0,this)}getVisibleAt(t){return this.validateInstanceId(t),this._instanceInfo[t].visible}setGeometryIdAt(t,e){return this.validateInstanceId(t),this.validateGeometryId(e),this._instanceInfo[t].geometryIndex=e,this._visibilityChanged=!0,this}getGeometryIdAt(t){return this.validateInstanceId(t),this._instanceInfo[t].geometryIndex}getGeometryRangeAt(t,e={}){this.validateGeometryId(t);let n=this._geometryInfo[t];return e.vertexStart=n.vertexStart,e.vertexCount=n.vertexCount,e.reservedVertexCount=n.reservedVertexCount,e.indexStart=n.indexStart,e.indexCount=n.indexCount,e.reservedIndexCount=n.reservedIndexCount,e.start=n.start,e.count=n.count,e}setInstanceCount(t){let e=this._availableInstanceIds,n=this._instanceInfo;for(e.sort(Nh);e[e.length-1]===n.length-1;)n.pop(),e.pop();if(t<n.length)throw new Error(`THREE.BatchedMesh: Instance ids outside the range ${t} are being used. Cannot shrink instance count.`);let s=new Int32Array(t),r=new Int32Array(t);si(this._multiDrawCounts,s),si(this._multiDrawStarts,r),this._multiDrawCounts=s,this._multiDrawStarts=r;let o=new Int32Array(t),a=new Int32Array(t),l=new Int32Array(t);si(this._mergedDrawCounts,o),si(this._mergedDrawStarts,a),si(this._mergedDrawInstanceCounts,l),this._mergedDrawCounts=o,this._mergedDrawStarts=a,this._mergedDrawInstanceCounts=l,this._maxInstanceCount=t;let c=this._indirectTexture,h=this._matricesTexture,u=this._colorsTexture;c.dispose(),this._initIndirectTexture(),si(c.image.data,this._indirectTexture.image.data),h.dispose(),this._initMatricesTexture(),si(h.image.data,this._matricesTexture.image.data),u&&(u.dispose(),this._initColorsTexture(),si(u.image.data,this._colorsTexture.image.data)),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}setGeometrySize(t,e){let n=[...this._geometryInfo].filter(a=>a.active);if(Math.max(...n.map(a=>a.vertexStart+a.reservedVertexCount))>t)throw new Error(`THREE.BatchedMesh: Geometry vertex values are being used outside the range ${t}. Cannot shrink further.`);if(this.geometry.index&&Math.max(...n.map(l=>l.indexStart+l.reservedIndexCount))>e)throw new Error(`THREE.BatchedMesh: Geometry index values are being used outside the range ${e}. Cannot shrink further.`);let r=this.geometry;r.dispose(),this._maxVertexCount=t,this._maxIndexCount=e,this._geometryInitialized&&(this._geometryInitialized=!1,this.geometry=new Le,this._initializeGeometry(r));let o=this.geometry;r.index&&si(r.index.array,o.index.array);for(let a in r.attributes)si(r.attributes[a].array,o.attributes[a].array);this._visibilityChanged=!0}raycast(t,e){let n=this._instanceInfo,s=this._geometryInfo,r=this.matrixWorld,o=this.geometry;ln.material=this.material,ln.geometry.index=o.index,ln.geometry.attributes=o.attributes,ln.geometry.boundingBox===null&&(ln.geometry.boundingBox=new le),ln.geometry.boundingSphere===null&&(ln.geometry.boundingSphere=new Pn);for(let a=0,l=n.length;a<l;a++){if(!n[a].visible||!n[a].active)continue;let c=n[a].geometryIndex,h=s[c];ln.geometry.setDrawRange(h.start,h.count),this.getMatrixAt(a,ln.matrixWorld).premultiply(r),this.getBoundingBoxAt(c,ln.geometry.boundingBox),this.getBoundingSphereAt(c,ln.geometry.boundingSphere),ln.raycast(t,ua);for(let u=0,d=ua.length;u<d;u++){let f=ua[u];f.object=this,f.batchId=a,e.push(f)}ua.length=0}ln.material=null,ln.geometry.index=null,ln.geometry.attributes={},ln.geometry.setDrawRange(0,1/0)}copy(t){return super.copy(t),this.geometry=t.geometry.clone(),this.perObjectFrustumCulled=t.perObjectFrustumCulled,this.sortObjects=t.sortObjects,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this._geometryInfo=t._geometryInfo.map(e=>({...e,boundingBox:e.boundingBox!==null?e.boundingBox.clone():null,boundingSphere:e.boundingSphere!==null?e.boundingSphere.clone():null})),this._instanceInfo=t._instanceInfo.map(e=>({...e})),this._availableInstanceIds=t._availableInstanceIds.slice(),this._availableGeometryIds=t._availableGeometryIds.slice(),this._nextIndexStart=t._nextIndexStart,this._nextVertexStart=t._nextVertexStart,this._geometryCount=t._geometryCount,this._maxInstanceCount=t._maxInstanceCount,this._maxVertexCount=t._maxVertexCount,this._maxIndexCount=t._maxIndexCount,this._geometryInitialized=t._geometryInitialized,this._multiDrawCounts=t._multiDrawCounts.slice(),this._multiDrawStarts=t._multiDrawStarts.slice(),this._multiDrawBytesPerElement=t._multiDrawBytesPerElement,this._mergedDrawCounts=t._mergedDrawCounts.slice(),this._mergedDrawStarts=t._mergedDrawStarts.slice(),this._mergedDrawInstanceCounts=t._mergedDrawInstanceCounts.slice(),this._indirectTexture=t._indirectTexture.clone(),this._indirectTexture.image.data=this._indirectTexture.image.data.slice(),this._matricesTexture=t._matricesTexture.clone(),this._matricesTexture.image.data=this._matricesTexture.image.data.slice(),t._colorsTexture!==null?(this._colorsTexture=t._colorsTexture.clone(),this._colorsTexture.image.data=this._colorsTexture.image.data.slice()):this._colorsTexture=null,this}dispose(){super.dispose(),this.geometry.dispose(),this._matricesTexture.dispose(),this._matricesTexture=null,this._indirectTexture.dispose(),this._indirectTexture=null,this._colorsTexture!==null&&(this._colorsTexture.dispose(),this._colorsTexture=null),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}_updateDrawParameters(t,e,n,s="multiDraw"){if(!this._visibilityChanged&&!this.perObjectFrustumCulled&&!this.sortObjects)return;let r=e.getIndex(),o=r===null?1:r.array.BYTES_PER_ELEMENT,a=1;n.wireframe&&(a=2,o=e.attributes.position.count>65535?4:2);let l=this._instanceInfo,c=this._multiDrawStarts,h=this._multiDrawCounts,u=this._mergedDrawStarts,d=this._mergedDrawCounts,f=this._mergedDrawInstanceCounts,p=this._geometryInfo,b=this.perObjectFrustumCulled,m=this._indirectTexture,g=m.image.data,w=t.isArrayCamera?Vv:zv;b&&(t.isArrayCamera?w.setFromArrayCamera(t):(_n.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse).multiply(this.matrixWorld),w.setFromProjectionMatrix(_n,t.coordinateSystem,t.reversedDepth)));let S=0,x=0;if(this.sortObjects){_n.copy(this.matrixWorld).invert(),qf.setFromMatrixPosition(t.matrixWorld).applyMatrix4(_n),Yf.set(0,0,-1).transformDirection(t.matrixWorld).transformDirection(_n);for(let v=0,M=l.length;v<M;v++)if(l[v].visible&&l[v].active){let N=l[v].geometryIndex;this.getMatrixAt(v,_n),this.getBoundingSphereAt(N,ds).applyMatrix4(_n);let C=!1;if(b&&(C=!w.intersectsSphere(ds)),!C){let L=p[N],I=Hv.subVectors(ds.center,qf).dot(Yf);Oh.push(L.start,L.count,I,v)}}let _=Oh.list,A=this.customSort;A===null?_.sort(n.transparent?Uv:Fv):A.call(this,_,t);for(let v=0,M=_.length;v<M;v++){let N=_[v],C=N.start*o*a,L=N.count*a;s==="merged"?x>0&&u[x-1]===C&&d[x-1]===L?f[x-1]++:(u[x]=C,d[x]=L,f[x]=1,x++):(c[S]=C,h[S]=L),g[S]=N.index,S++}Oh.reset()}else for(let _=0,A=l.length;_<A;_++)if(l[_].visible&&l[_].active){let v=l[_].geometryIndex,M=!1;if(b&&(this.getMatrixAt(_,_n),this.getBoundingSphereAt(v,ds).applyMatrix4(_n),M=!w.intersectsSphere(ds)),!M){let N=p[v],C=N.start*o*a,L=N.count*a;s==="merged"?x>0&&u[x-1]===C&&d[x-1]===L?f[x-1]++:(u[x]=C,d[x]=L,f[x]=1,x++):(c[S]=C,h[S]=L),g[S]=_,S++}}m.needsUpdate=!0,this._multiDrawCount=S,this._mergedDrawCount=x,this._multiDrawBytesPerElement=o,this._visibilityChanged=!1}onBeforeRender(t,e,n,s,r){t.isWebGPURenderer===!0?(this._visibilityChanged||this.perObjectFrustumCulled||this.sortObjects)&&(this._indirectTexture.needsUpdate=!0):this._updateDrawParameters(n,s,r)}onBeforeShadow(t,e,n,s,r,o){t.isWebGPURenderer!==!0&&this._updateDrawParameters(s,r,o)}};var Da=class extends Gi{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Ot(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},Zf=new Mt,Gh=new Wi,da=new Pn,fa=new P,Xr=class extends Ln{constructor(t=new Le,e=new Da){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.matrixWorld,r=t.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),da.copy(n.boundingSphere),da.applyMatrix4(s),da.radius+=r,t.ray.intersectsSphere(da)===!1)return;Zf.copy(s).invert(),Gh.copy(t.ray).applyMatrix4(Zf);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let p=d,b=f;p<b;p++){let m=c.getX(p);fa.fromBufferAttribute(u,m),Jf(fa,m,l,s,t,e,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let p=d,b=f;p<b;p++)fa.fromBufferAttribute(u,p),Jf(fa,p,l,s,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Jf(i,t,e,n,s,r,o){let a=Gh.distanceSqToPoint(i);if(a<e){let l=new P;Gh.closestPointToPoint(i,l),l.applyMatrix4(n);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var qr=class extends Sn{constructor(t=[],e=ps,n,s,r,o,a,l,c,h){super(t,e,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var Jn=class extends Sn{constructor(t,e,n=Mn,s,r,o,a=Se,l=Se,c,h=Ei,u=1){if(h!==Ei&&h!==Pi)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:t,height:e,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new $s(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Yr=class extends Jn{constructor(t,e=Mn,n=ps,s,r,o=Se,a=Se,l,c=Ei){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},Zr=class extends Sn{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Ys=class i extends Le{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;p("z","y","x",-1,-1,n,e,t,o,r,0),p("z","y","x",1,-1,n,e,-t,o,r,1),p("x","z","y",1,1,t,n,e,s,o,2),p("x","z","y",1,-1,t,n,-e,s,o,3),p("x","y","z",1,-1,t,e,n,s,r,4),p("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new $e(c,3)),this.setAttribute("normal",new $e(h,3)),this.setAttribute("uv",new $e(u,2));function p(b,m,g,w,S,x,_,A,v,M,N){let C=x/v,L=_/M,I=x/2,F=_/2,k=A/2,B=v+1,G=M+1,W=0,et=0,X=new P;for(let Q=0;Q<G;Q++){let tt=Q*L-F;for(let yt=0;yt<B;yt++){let Nt=yt*C-I;X[b]=Nt*w,X[m]=tt*S,X[g]=k,c.push(X.x,X.y,X.z),X[b]=0,X[m]=0,X[g]=A>0?1:-1,h.push(X.x,X.y,X.z),u.push(yt/v),u.push(1-Q/M),W+=1}}for(let Q=0;Q<M;Q++)for(let tt=0;tt<v;tt++){let yt=d+tt+B*Q,Nt=d+tt+B*(Q+1),J=d+(tt+1)+B*(Q+1),ht=d+(tt+1)+B*Q;l.push(yt,Nt,ht),l.push(Nt,J,ht),et+=6}a.addGroup(f,et,N),f+=et,d+=W}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Ai=class i extends Le{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=t/a,d=e/l,f=[],p=[],b=[],m=[];for(let g=0;g<h;g++){let w=g*d-o;for(let S=0;S<c;S++){let x=S*u-r;p.push(x,-w,0),b.push(0,0,1),m.push(S/a),m.push(1-g/l)}}for(let g=0;g<l;g++)for(let w=0;w<a;w++){let S=w+c*g,x=w+c*(g+1),_=w+1+c*(g+1),A=w+1+c*g;f.push(S,x,A),f.push(x,_,A)}this.setIndex(f),this.setAttribute("position",new $e(p,3)),this.setAttribute("normal",new $e(b,3)),this.setAttribute("uv",new $e(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.widthSegments,t.heightSegments)}};function xs(i){let t={};for(let e in i){t[e]={};for(let n in i[e]){let s=i[e][n];if(Kf(s))s.isRenderTargetTexture?(It("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone();else if(Array.isArray(s))if(Kf(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][n]=r}else t[e][n]=s.slice();else t[e][n]=s}}return t}function un(i){let t={};for(let e=0;e<i.length;e++){let n=xs(i[e]);for(let s in n)t[s]=n[s]}return t}function Kf(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function Wv(i){let t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function bu(i){let t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:$t.workingColorSpace}var Hp={clone:xs,merge:un},$v=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Xv=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,hn=class extends Gi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=$v,this.fragmentShader=Xv,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=xs(t.uniforms),this.uniformsGroups=Wv(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let n in t.uniforms){let s=t.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=e[s.value]||null;break;case"c":this.uniforms[n].value=new Ot().setHex(s.value);break;case"v2":this.uniforms[n].value=new Et().fromArray(s.value);break;case"v3":this.uniforms[n].value=new P().fromArray(s.value);break;case"v4":this.uniforms[n].value=new Wt().fromArray(s.value);break;case"m3":this.uniforms[n].value=new Dt().fromArray(s.value);break;case"m4":this.uniforms[n].value=new Mt().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let n in t.extensions)this.extensions[n]=t.extensions[n];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Oa=class extends hn{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Fa=class extends Gi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Ap,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},Ua=class extends Gi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function Fs(i,t){return!i||i.constructor===t?i:typeof t.BYTES_PER_ELEMENT=="number"?new t(i):Array.prototype.slice.call(i)}function pa(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var $i=class{constructor(t,e,n,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,s=e[n],r=e[n-1];n:{t:{let o;e:{i:if(!(t<s)){for(let a=n+2;;){if(s===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=e[++n],t<s)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=e[--n-1],t>=r)break t}o=n,n=0;break e}break n}for(;n<o;){let a=n+o>>>1;t<e[a]?o=a:n=a+1}if(s=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=n[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Ba=class extends $i{constructor(t,e,n,s){super(t,e,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Bh,endingEnd:Bh}}intervalChanged_(t,e,n){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case zh:r=t,a=2*e-n;break;case Vh:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case zh:o=t,l=2*n-e;break;case Vh:o=1,l=n+s[1]-s[0];break;default:o=t-1,l=e}let c=(n-e)*.5,h=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,p=(n-e)/(s-e),b=p*p,m=b*p,g=-d*m+2*d*b-d*p,w=(1+d)*m+(-1.5-2*d)*b+(-.5+d)*p+1,S=(-1-f)*m+(1.5+f)*b+.5*p,x=f*m-f*b;for(let _=0;_!==a;++_)r[_]=g*o[h+_]+w*o[c+_]+S*o[l+_]+x*o[u+_];return r}},za=class extends $i{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=(n-e)/(s-e),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},Va=class extends $i{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t){return this.copySampleValue_(t-1)}},Ha=class extends $i{interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let p=(n-e)/(s-e),b=1-p;for(let m=0;m!==a;++m)r[m]=o[c+m]*b+o[l+m]*p;return r}let d=a*2,f=t-1;for(let p=0;p!==a;++p){let b=o[c+p],m=o[l+p],g=f*d+p*2,w=u[g],S=u[g+1],x=t*d+p*2,_=h[x],A=h[x+1],v=Yv(n,e,w,_,s);r[p]=Gp(v,b,S,A,m)}return r}};function Gp(i,t,e,n,s){let r=1-i;return r*r*r*t+3*r*r*i*e+3*r*i*i*n+i*i*i*s}function qv(i,t,e,n,s){let r=1-i;return 3*r*r*(e-t)+6*r*i*(n-e)+3*i*i*(s-n)}function Yv(i,t,e,n,s){let r=(i-t)/(s-t);for(let o=0;o<8;o++){let a=Gp(r,t,e,n,s)-i;if(Math.abs(a)<1e-10)break;let l=qv(r,t,e,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var In=class{constructor(t,e,n,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=Fs(e,this.TimeBufferType),this.values=Fs(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:Fs(t.times,Array),values:Fs(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(n.interpolation=s),pa(t.settings)&&(n.settings={inTangents:Fs(t.settings.inTangents,Array),outTangents:Fs(t.settings.outTangents,Array)})}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new Va(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new za(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new Ba(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new Ha(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case Dr:e=this.InterpolantFactoryMethodDiscrete;break;case Pa:e=this.InterpolantFactoryMethodLinear;break;case va:e=this.InterpolantFactoryMethodSmooth;break;case Uh:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return It("KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Dr;case this.InterpolantFactoryMethodLinear:return Pa;case this.InterpolantFactoryMethodSmooth:return va;case this.InterpolantFactoryMethodBezier:return Uh}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]+=t;pa(this.settings)&&(jf(this.settings.inTangents,t),jf(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]*=t;pa(this.settings)&&(Qf(this.settings.inTangents,t),Qf(this.settings.outTangents,t))}return this}trim(t,e){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<t;)++r;for(;o!==-1&&n[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(kt("KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,s=this.values,r=n.length;r===0&&(kt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){kt("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){kt("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(s!==void 0&&mv(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){kt("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===va,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],h=t[a+1];if(c!==h&&(a!==1||c!==t[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let p=0;p!==n;++p){let b=e[u+p];if(b!==e[d+p]||b!==e[f+p]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)e[d+f]=e[u+f]}++o}}if(r>0){t[o]=t[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,s=new n(this.name,t,e);return s.createInterpolant=this.createInterpolant,pa(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function jf(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]+=t}function Qf(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]*=t}In.prototype.ValueTypeName="";In.prototype.TimeBufferType=Float32Array;In.prototype.ValueBufferType=Float32Array;In.prototype.DefaultInterpolation=Pa;var Xi=class extends In{constructor(t,e,n){super(t,e,n)}};Xi.prototype.ValueTypeName="bool";Xi.prototype.ValueBufferType=Array;Xi.prototype.DefaultInterpolation=Dr;Xi.prototype.InterpolantFactoryMethodLinear=void 0;Xi.prototype.InterpolantFactoryMethodSmooth=void 0;var Ga=class extends In{constructor(t,e,n,s){super(t,e,n,s)}};Ga.prototype.ValueTypeName="color";var Wa=class extends In{constructor(t,e,n,s){super(t,e,n,s)}};Wa.prototype.ValueTypeName="number";var $a=class extends $i{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-e)/(s-e),c=t*a;for(let h=c+a;c!==h;c+=4)Gn.slerpFlat(r,0,o,c-a,o,c,l);return r}},Jr=class extends In{constructor(t,e,n,s){super(t,e,n,s)}InterpolantFactoryMethodLinear(t){return new $a(this.times,this.values,this.getValueSize(),t)}};Jr.prototype.ValueTypeName="quaternion";Jr.prototype.InterpolantFactoryMethodSmooth=void 0;var qi=class extends In{constructor(t,e,n){super(t,e,n)}};qi.prototype.ValueTypeName="string";qi.prototype.ValueBufferType=Array;qi.prototype.DefaultInterpolation=Dr;qi.prototype.InterpolantFactoryMethodLinear=void 0;qi.prototype.InterpolantFactoryMethodSmooth=void 0;var Xa=class extends In{constructor(t,e,n,s){super(t,e,n,s)}};Xa.prototype.ValueTypeName="vector";var qa=class{constructor(t,e,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],p=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Wp=new qa,Ya=class{constructor(t){this.manager=t!==void 0?t:Wp,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let n=this;return new Promise(function(s,r){n.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};Ya.DEFAULT_MATERIAL_NAME="__DEFAULT";var ma=new P,ga=new Gn,ri=new P,Kr=class extends Ln{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Mt,this.projectionMatrix=new Mt,this.projectionMatrixInverse=new Mt,this.coordinateSystem=Hn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(ma,ga,ri),ri.x===1&&ri.y===1&&ri.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ma,ga,ri.set(1,1,1)).invert()}updateWorldMatrix(t,e,n=!1){super.updateWorldMatrix(t,e,n),this.matrixWorld.decompose(ma,ga,ri),ri.x===1&&ri.y===1&&ri.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ma,ga,ri.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Vi=new P,tp=new Et,ep=new Et,mn=class extends Kr{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Ra*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(fh*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Ra*2*Math.atan(Math.tan(fh*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){Vi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(Vi.x,Vi.y).multiplyScalar(-t/Vi.z),Vi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Vi.x,Vi.y).multiplyScalar(-t/Vi.z)}getViewSize(t,e){return this.getViewBounds(t,tp,ep),e.subVectors(ep,tp)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(fh*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var Kn=class extends Kr{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}};var Zs=class extends Le{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var Us=-90,Bs=1,Js=class extends Ln{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new mn(Us,Bs,t,e);s.layers=this.layers,this.add(s);let r=new mn(Us,Bs,t,e);r.layers=this.layers,this.add(r);let o=new mn(Us,Bs,t,e);o.layers=this.layers,this.add(o);let a=new mn(Us,Bs,t,e);a.layers=this.layers,this.add(a);let l=new mn(Us,Bs,t,e);l.layers=this.layers,this.add(l);let c=new mn(Us,Bs,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===Hn)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Ur)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),d=t.getActiveCubeFace(),f=t.getActiveMipmapLevel(),p=t.xr.enabled;t.xr.enabled=!1;let b=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let m=!1;t.isWebGLRenderer===!0?m=t.state.buffers.depth.getReversed():m=t.reversedDepthBuffer,t.setRenderTarget(n,0,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(n,1,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(n,2,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(n,3,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(n,4,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),n.texture.mipmapsAutoUpdate=b,t.setRenderTarget(n,5,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,d,f),t.xr.enabled=p,n.texture.needsPMREMUpdate=!0}},Za=class extends mn{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var wu="\\[\\]\\.:\\/",Zv=new RegExp("["+wu+"]","g"),_u="[^"+wu+"]",Jv="[^"+wu.replace("\\.","")+"]",Kv=/((?:WC+[\/:])*)/.source.replace("WC",_u),jv=/(WCOD+)?/.source.replace("WCOD",Jv),Qv=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",_u),ty=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",_u),ey=new RegExp("^"+Kv+jv+Qv+ty+"$"),ny=["material","materials","bones","map"],Wh=class{constructor(t,e,n){let s=n||xe.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},xe=class i{constructor(t,e,n){this.path=e,this.parsedPath=n||i.parseTrackName(e),this.node=i.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new i.Composite(t,e,n):new i(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(Zv,"")}static parseTrackName(t){let e=ey.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);ny.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=n(a.children);if(l)return l}return null},s=n(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)t[e++]=n[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=i.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){It("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){kt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){kt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){kt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){kt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){kt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){kt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){kt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[s];if(o===void 0){let c=e.nodeName;kt("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){kt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){kt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};xe.Composite=Wh;xe.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};xe.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};xe.prototype.GetterByBindingType=[xe.prototype._getValue_direct,xe.prototype._getValue_array,xe.prototype._getValue_arrayElement,xe.prototype._getValue_toArray];xe.prototype.SetterByBindingTypeAndVersioning=[[xe.prototype._setValue_direct,xe.prototype._setValue_direct_setNeedsUpdate,xe.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[xe.prototype._setValue_array,xe.prototype._setValue_array_setNeedsUpdate,xe.prototype._setValue_array_setMatrixWorldNeedsUpdate],[xe.prototype._setValue_arrayElement,xe.prototype._setValue_arrayElement_setNeedsUpdate,xe.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[xe.prototype._setValue_fromArray,xe.prototype._setValue_fromArray_setNeedsUpdate,xe.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var BA=new Float32Array(1);var np=new Mt,jr=class{constructor(t,e,n=0,s=1/0){this.ray=new Wi(t,e),this.near=n,this.far=s,this.camera=null,this.layers=new Xs,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):kt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return np.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(np),this}intersectObject(t,e=!0,n=[]){return $h(t,this,n,e),n.sort(ip),n}intersectObjects(t,e=!0,n=[]){for(let s=0,r=t.length;s<r;s++)$h(t[s],this,n,e);return n.sort(ip),n}};function ip(i,t){return i.distance-t.distance}function $h(i,t,e,n){let s=!0;if(i.layers.test(t.layers)&&i.raycast(t,e)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)$h(r[o],t,e,!0)}}var Xh=class{static{this.prototype.isMatrix2=!0}constructor(t,e,n,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let n=0;n<4;n++)this.elements[n]=t[n+e];return this}set(t,e,n,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=n,r[3]=s,this}};var sp=new P,xa=new P,zs=new P,Vs=new P,Fh=new P,iy=new P,sy=new P,Qe=class{constructor(t=new P,e=new P){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){sp.subVectors(t,this.start),xa.subVectors(this.end,this.start);let n=xa.dot(xa);if(n===0)return 0;let r=xa.dot(sp)/n;return e&&(r=Vt(r,0,1)),r}closestPointToPoint(t,e,n){let s=this.closestPointToPointParameter(t,e);return this.delta(n).multiplyScalar(s).add(this.start)}distanceSqToLine3(t,e=iy,n=sy){let s=10000000000000001e-32,r,o,a=this.start,l=t.start,c=this.end,h=t.end;zs.subVectors(c,a),Vs.subVectors(h,l),Fh.subVectors(a,l);let u=zs.dot(zs),d=Vs.dot(Vs),f=Vs.dot(Fh);if(u<=s&&d<=s)return e.copy(a),n.copy(l),e.distanceToSquared(n);if(u<=s)r=0,o=f/d,o=Vt(o,0,1);else{let p=zs.dot(Fh);if(d<=s)o=0,r=Vt(-p/u,0,1);else{let b=zs.dot(Vs),m=u*d-b*b;m!==0?r=Vt((b*f-p*d)/m,0,1):r=0,o=(b*r+f)/d,o<0?(o=0,r=Vt(-p/u,0,1)):o>1&&(o=1,r=Vt((b-p)/u,0,1))}}return e.copy(a).addScaledVector(zs,r),n.copy(l).addScaledVector(Vs,o),e.distanceToSquared(n)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};function Su(i,t,e,n){let s=ry(n);switch(e){case hu:return i*t;case du:return i*t/s.components*s.byteLength;case io:return i*t/s.components*s.byteLength;case Yi:return i*t*2/s.components*s.byteLength;case il:return i*t*2/s.components*s.byteLength;case uu:return i*t*3/s.components*s.byteLength;case je:return i*t*4/s.components*s.byteLength;case sl:return i*t*4/s.components*s.byteLength;case so:case ro:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case oo:case ao:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case ol:case ll:return Math.max(i,16)*Math.max(t,8)/4;case rl:case al:return Math.max(i,8)*Math.max(t,8)/2;case cl:case hl:case dl:case fl:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case ul:case lo:case pl:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case ml:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case gl:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case xl:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case vl:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case yl:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case bl:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case wl:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case _l:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case Sl:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case Ml:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case Tl:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case El:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case Al:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case Cl:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case Pl:case Rl:case Ll:return Math.ceil(i/4)*Math.ceil(t/4)*16;case Il:case kl:return Math.ceil(i/4)*Math.ceil(t/4)*8;case co:case Nl:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function ry(i){switch(i){case en:case ou:return{byteLength:1,components:1};case er:case au:case kn:return{byteLength:2,components:1};case el:case nl:return{byteLength:2,components:4};case Mn:case tl:case Rn:return{byteLength:4,components:1};case lu:case cu:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?It("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function dm(){let i=null,t=!1,e=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&i!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function oy(i){let t=new WeakMap;function e(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,p)=>f.start-p.start);let d=0;for(let f=1;f<u.length;f++){let p=u[d],b=u[f];b.start<=p.start+p.count+1?p.count=Math.max(p.count,b.start+b.count-p.start):(++d,u[d]=b)}u.length=d+1;for(let f=0,p=u.length;f<p;f++){let b=u[f];i.bufferSubData(c,b.start*h.BYTES_PER_ELEMENT,h,b.start,b.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var ay=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,ly=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,cy=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,hy=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,uy=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,dy=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,fy=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,py=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,my=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,gy=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,xy=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,vy=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,yy=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,by=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,wy=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,_y=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Sy=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,My=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Ty=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Ey=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Ay=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Cy=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Py=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Ry=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Ly=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Iy=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,ky=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Ny=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Dy=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Oy="gl_FragColor = linearToOutputTexel( gl_FragColor );",Fy=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Uy=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,By=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,zy=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Vy=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Hy=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Gy=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Wy=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,$y=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Xy=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,qy=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,Yy=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Zy=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Jy=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,Ky=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,jy=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,Qy=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,tb=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,eb=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,nb=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,ib=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,sb=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,rb=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,ob=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,ab=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,lb=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,cb=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,hb=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,ub=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,db=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,fb=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,pb=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,mb=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,gb=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,xb=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,vb=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,yb=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,bb=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,wb=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,_b=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,Sb=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Mb=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,Tb=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Eb=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Ab=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Cb=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,Pb=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Rb=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Lb=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Ib=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,kb=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Nb=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Db=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,Ob=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Fb=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Ub=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Bb=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,zb=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Vb=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Hb=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,Gb=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Wb=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,$b=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Xb=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,qb=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,Yb=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Zb=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Jb=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Kb=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,jb=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Qb=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,tw=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,ew=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,nw=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,iw=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,sw=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,rw=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,ow=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,aw=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,lw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,cw=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,hw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,uw=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,dw=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,fw=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,pw=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,mw=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,gw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,xw=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,vw=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,yw=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,bw=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,ww=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,_w=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Sw=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Mw=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,Tw=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ew=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Aw=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,Cw=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Pw=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Rw=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Lw=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Iw=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,kw=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Nw=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Dw=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Ow=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Fw=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Uw=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Bw=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Gt={alphahash_fragment:ay,alphahash_pars_fragment:ly,alphamap_fragment:cy,alphamap_pars_fragment:hy,alphatest_fragment:uy,alphatest_pars_fragment:dy,aomap_fragment:fy,aomap_pars_fragment:py,batching_pars_vertex:my,batching_vertex:gy,begin_vertex:xy,beginnormal_vertex:vy,bsdfs:yy,iridescence_fragment:by,bumpmap_pars_fragment:wy,clipping_planes_fragment:_y,clipping_planes_pars_fragment:Sy,clipping_planes_pars_vertex:My,clipping_planes_vertex:Ty,color_fragment:Ey,color_pars_fragment:Ay,color_pars_vertex:Cy,color_vertex:Py,common:Ry,defaultnormal_vertex:Ly,displacementmap_pars_vertex:Iy,displacementmap_vertex:ky,emissivemap_fragment:Ny,emissivemap_pars_fragment:Dy,colorspace_fragment:Oy,colorspace_pars_fragment:Fy,envmap_fragment:Uy,envmap_common_pars_fragment:By,envmap_pars_fragment:zy,envmap_pars_vertex:Vy,envmap_physical_pars_fragment:jy,envmap_vertex:Hy,fog_vertex:Gy,fog_pars_vertex:Wy,fog_fragment:$y,fog_pars_fragment:Xy,gradientmap_pars_fragment:qy,lightmap_pars_fragment:Yy,lights_lambert_fragment:Zy,lights_lambert_pars_fragment:Jy,lights_pars_begin:Ky,lights_toon_fragment:Qy,lights_toon_pars_fragment:tb,lights_phong_fragment:eb,lights_phong_pars_fragment:nb,lights_physical_fragment:ib,lights_physical_pars_fragment:sb,lights_fragment_begin:rb,lights_fragment_maps:ob,lights_fragment_end:ab,lightprobes_pars_fragment:lb,logdepthbuf_fragment:cb,logdepthbuf_pars_fragment:hb,logdepthbuf_pars_vertex:ub,logdepthbuf_vertex:db,map_fragment:fb,map_pars_fragment:pb,map_particle_fragment:mb,map_particle_pars_fragment:gb,metalnessmap_fragment:xb,metalnessmap_pars_fragment:vb,morphinstance_vertex:yb,morphcolor_vertex:bb,morphnormal_vertex:wb,morphtarget_pars_vertex:_b,morphtarget_vertex:Sb,normal_fragment_begin:Mb,normal_fragment_maps:Tb,normal_pars_fragment:Eb,normal_pars_vertex:Ab,normal_vertex:Cb,normalmap_pars_fragment:Pb,clearcoat_normal_fragment_begin:Rb,clearcoat_normal_fragment_maps:Lb,clearcoat_pars_fragment:Ib,iridescence_pars_fragment:kb,opaque_fragment:Nb,packing:Db,premultiplied_alpha_fragment:Ob,project_vertex:Fb,dithering_fragment:Ub,dithering_pars_fragment:Bb,roughnessmap_fragment:zb,roughnessmap_pars_fragment:Vb,shadowmap_pars_fragment:Hb,shadowmap_pars_vertex:Gb,shadowmap_vertex:Wb,shadowmask_pars_fragment:$b,skinbase_vertex:Xb,skinning_pars_vertex:qb,skinning_vertex:Yb,skinnormal_vertex:Zb,specularmap_fragment:Jb,specularmap_pars_fragment:Kb,tonemapping_fragment:jb,tonemapping_pars_fragment:Qb,transmission_fragment:tw,transmission_pars_fragment:ew,uv_pars_fragment:nw,uv_pars_vertex:iw,uv_vertex:sw,worldpos_vertex:rw,background_vert:ow,background_frag:aw,backgroundCube_vert:lw,backgroundCube_frag:cw,cube_vert:hw,cube_frag:uw,depth_vert:dw,depth_frag:fw,distance_vert:pw,distance_frag:mw,equirect_vert:gw,equirect_frag:xw,linedashed_vert:vw,linedashed_frag:yw,meshbasic_vert:bw,meshbasic_frag:ww,meshlambert_vert:_w,meshlambert_frag:Sw,meshmatcap_vert:Mw,meshmatcap_frag:Tw,meshnormal_vert:Ew,meshnormal_frag:Aw,meshphong_vert:Cw,meshphong_frag:Pw,meshphysical_vert:Rw,meshphysical_frag:Lw,meshtoon_vert:Iw,meshtoon_frag:kw,points_vert:Nw,points_frag:Dw,shadow_vert:Ow,shadow_frag:Fw,sprite_vert:Uw,sprite_frag:Bw},gt={common:{diffuse:{value:new Ot(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Dt},alphaMap:{value:null},alphaMapTransform:{value:new Dt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Dt}},envmap:{envMap:{value:null},envMapRotation:{value:new Dt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Dt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Dt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Dt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Dt},normalScale:{value:new Et(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Dt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Dt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Dt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Dt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Ot(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Ot(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Dt},alphaTest:{value:0},uvTransform:{value:new Dt}},sprite:{diffuse:{value:new Ot(16777215)},opacity:{value:1},center:{value:new Et(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Dt},alphaMap:{value:null},alphaMapTransform:{value:new Dt},alphaTest:{value:0}}},fi={basic:{uniforms:un([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.fog]),vertexShader:Gt.meshbasic_vert,fragmentShader:Gt.meshbasic_frag},lambert:{uniforms:un([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,gt.lights,{emissive:{value:new Ot(0)},envMapIntensity:{value:1}}]),vertexShader:Gt.meshlambert_vert,fragmentShader:Gt.meshlambert_frag},phong:{uniforms:un([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,gt.lights,{emissive:{value:new Ot(0)},specular:{value:new Ot(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphong_vert,fragmentShader:Gt.meshphong_frag},standard:{uniforms:un([gt.common,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.roughnessmap,gt.metalnessmap,gt.fog,gt.lights,{emissive:{value:new Ot(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag},toon:{uniforms:un([gt.common,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.gradientmap,gt.fog,gt.lights,{emissive:{value:new Ot(0)}}]),vertexShader:Gt.meshtoon_vert,fragmentShader:Gt.meshtoon_frag},matcap:{uniforms:un([gt.common,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,{matcap:{value:null}}]),vertexShader:Gt.meshmatcap_vert,fragmentShader:Gt.meshmatcap_frag},points:{uniforms:un([gt.points,gt.fog]),vertexShader:Gt.points_vert,fragmentShader:Gt.points_frag},dashed:{uniforms:un([gt.common,gt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Gt.linedashed_vert,fragmentShader:Gt.linedashed_frag},depth:{uniforms:un([gt.common,gt.displacementmap]),vertexShader:Gt.depth_vert,fragmentShader:Gt.depth_frag},normal:{uniforms:un([gt.common,gt.bumpmap,gt.normalmap,gt.displacementmap,{opacity:{value:1}}]),vertexShader:Gt.meshnormal_vert,fragmentShader:Gt.meshnormal_frag},sprite:{uniforms:un([gt.sprite,gt.fog]),vertexShader:Gt.sprite_vert,fragmentShader:Gt.sprite_frag},background:{uniforms:{uvTransform:{value:new Dt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Gt.background_vert,fragmentShader:Gt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Dt}},vertexShader:Gt.backgroundCube_vert,fragmentShader:Gt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Gt.cube_vert,fragmentShader:Gt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Gt.equirect_vert,fragmentShader:Gt.equirect_frag},distance:{uniforms:un([gt.common,gt.displacementmap,{referencePosition:{value:new P},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Gt.distance_vert,fragmentShader:Gt.distance_frag},shadow:{uniforms:un([gt.lights,gt.fog,{color:{value:new Ot(0)},opacity:{value:1}}]),vertexShader:Gt.shadow_vert,fragmentShader:Gt.shadow_frag}};fi.physical={uniforms:un([fi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Dt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Dt},clearcoatNormalScale:{value:new Et(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Dt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Dt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Dt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Dt},sheen:{value:0},sheenColor:{value:new Ot(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Dt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Dt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Dt},transmissionSamplerSize:{value:new Et},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Dt},attenuationDistance:{value:0},attenuationColor:{value:new Ot(0)},specularColor:{value:new Ot(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Dt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Dt},anisotropyVector:{value:new Et},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Dt}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag};var Dl={r:0,b:0,g:0},zw=new Mt,fm=new Dt;fm.set(-1,0,0,0,1,0,0,0,1);function Vw(i,t,e,n,s,r){let o=new Ot(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(w){let S=w.isScene===!0?w.background:null;if(S&&S.isTexture){let x=w.backgroundBlurriness>0;S=t.get(S,x)}return S}function p(w){let S=!1,x=f(w);x===null?m(o,a):x&&x.isColor&&(m(x,1),S=!0);let _=i.xr.getEnvironmentBlendMode();_==="additive"?e.buffers.color.setClear(0,0,0,1,r):_==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(i.autoClear||S)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function b(w,S){let x=f(S);x&&x.isCubeTexture?(c===void 0&&(c=new Ie(new Ys(1,1,1),new hn({name:"BackgroundCubeMaterial",uniforms:xs(fi.backgroundCube.uniforms),vertexShader:fi.backgroundCube.vertexShader,fragmentShader:fi.backgroundCube.fragmentShader,side:tn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(_,A,v){this.matrixWorld.copyPosition(v.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=x,c.material.uniforms.backgroundBlurriness.value=S.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(zw.makeRotationFromEuler(S.backgroundRotation)).transpose(),x.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(fm),c.material.toneMapped=$t.getTransfer(x.colorSpace)!==re,(h!==x||u!==x.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=x,u=x.version,d=i.toneMapping),c.layers.enableAll(),w.unshift(c,c.geometry,c.material,0,0,null)):x&&x.isTexture&&(l===void 0&&(l=new Ie(new Ai(2,2),new hn({name:"BackgroundMaterial",uniforms:xs(fi.background.uniforms),vertexShader:fi.background.vertexShader,fragmentShader:fi.background.fragmentShader,side:jn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=x,l.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,l.material.toneMapped=$t.getTransfer(x.colorSpace)!==re,x.matrixAutoUpdate===!0&&x.updateMatrix(),l.material.uniforms.uvTransform.value.copy(x.matrix),(h!==x||u!==x.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=x,u=x.version,d=i.toneMapping),l.layers.enableAll(),w.unshift(l,l.geometry,l.material,0,0,null))}function m(w,S){w.getRGB(Dl,bu(i)),e.buffers.color.setClear(Dl.r,Dl.g,Dl.b,S,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(w,S=1){o.set(w),a=S,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(w){a=w,m(o,a)},render:p,addToRenderList:b,dispose:g}}function Hw(i,t){let e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(L,I,F,k,B){let G=!1,W=u(L,k,F,I);r!==W&&(r=W,c(r.object)),G=f(L,k,F,B),G&&p(L,k,F,B),B!==null&&t.update(B,i.ELEMENT_ARRAY_BUFFER),(G||o)&&(o=!1,x(L,I,F,k),B!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(B).buffer))}function l(){return i.createVertexArray()}function c(L){return i.bindVertexArray(L)}function h(L){return i.deleteVertexArray(L)}function u(L,I,F,k){let B=k.wireframe===!0,G=n[I.id];G===void 0&&(G={},n[I.id]=G);let W=L.isInstancedMesh===!0?L.id:0,et=G[W];et===void 0&&(et={},G[W]=et);let X=et[F.id];X===void 0&&(X={},et[F.id]=X);let Q=X[B];return Q===void 0&&(Q=d(l()),X[B]=Q),Q}function d(L){let I=[],F=[],k=[];for(let B=0;B<e;B++)I[B]=0,F[B]=0,k[B]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:I,enabledAttributes:F,attributeDivisors:k,object:L,attributes:{},index:null}}function f(L,I,F,k){let B=r.attributes,G=I.attributes,W=0,et=F.getAttributes();for(let X in et)if(et[X].location>=0){let tt=B[X],yt=G[X];if(yt===void 0&&(X==="instanceMatrix"&&L.instanceMatrix&&(yt=L.instanceMatrix),X==="instanceColor"&&L.instanceColor&&(yt=L.instanceColor)),tt===void 0||tt.attribute!==yt||yt&&tt.data!==yt.data)return!0;W++}return r.attributesNum!==W||r.index!==k}function p(L,I,F,k){let B={},G=I.attributes,W=0,et=F.getAttributes();for(let X in et)if(et[X].location>=0){let tt=G[X];tt===void 0&&(X==="instanceMatrix"&&L.instanceMatrix&&(tt=L.instanceMatrix),X==="instanceColor"&&L.instanceColor&&(tt=L.instanceColor));let yt={};yt.attribute=tt,tt&&tt.data&&(yt.data=tt.data),B[X]=yt,W++}r.attributes=B,r.attributesNum=W,r.index=k}function b(){let L=r.newAttributes;for(let I=0,F=L.length;I<F;I++)L[I]=0}function m(L){g(L,0)}function g(L,I){let F=r.newAttributes,k=r.enabledAttributes,B=r.attributeDivisors;F[L]=1,k[L]===0&&(i.enableVertexAttribArray(L),k[L]=1),B[L]!==I&&(i.vertexAttribDivisor(L,I),B[L]=I)}function w(){let L=r.newAttributes,I=r.enabledAttributes;for(let F=0,k=I.length;F<k;F++)I[F]!==L[F]&&(i.disableVertexAttribArray(F),I[F]=0)}function S(L,I,F,k,B,G,W){W===!0?i.vertexAttribIPointer(L,I,F,B,G):i.vertexAttribPointer(L,I,F,k,B,G)}function x(L,I,F,k){b();let B=k.attributes,G=F.getAttributes(),W=I.defaultAttributeValues;for(let et in G){let X=G[et];if(X.location>=0){let Q=B[et];if(Q===void 0&&(et==="instanceMatrix"&&L.instanceMatrix&&(Q=L.instanceMatrix),et==="instanceColor"&&L.instanceColor&&(Q=L.instanceColor)),Q!==void 0){let tt=Q.normalized,yt=Q.itemSize,Nt=t.get(Q);if(Nt===void 0)continue;let J=Nt.buffer,ht=Nt.type,vt=Nt.bytesPerElement,Ct=ht===i.INT||ht===i.UNSIGNED_INT||Q.gpuType===tl;if(Q.isInterleavedBufferAttribute){let pt=Q.data,Ft=pt.isInterleavedBuffer===!0?pt.stride:pt.itemSize,Te=Q.offset;if(pt.isInstancedInterleavedBuffer||pt.isInstancedBufferAttribute){for(let Pt=0;Pt<X.locationSize;Pt++)g(X.location+Pt,pt.meshPerAttribute);L.isInstancedMesh!==!0&&k._maxInstanceCount===void 0&&(k._maxInstanceCount=pt.meshPerAttribute*pt.count)}else for(let Pt=0;Pt<X.locationSize;Pt++)m(X.location+Pt);i.bindBuffer(i.ARRAY_BUFFER,J);for(let Pt=0;Pt<X.locationSize;Pt++)S(X.location+Pt,yt/X.locationSize,ht,tt,Ft*vt,(Te+yt/X.locationSize*Pt)*vt,Ct)}else{if(Q.isInstancedBufferAttribute){for(let pt=0;pt<X.locationSize;pt++)g(X.location+pt,Q.meshPerAttribute);L.isInstancedMesh!==!0&&k._maxInstanceCount===void 0&&(k._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let pt=0;pt<X.locationSize;pt++)m(X.location+pt);i.bindBuffer(i.ARRAY_BUFFER,J);for(let pt=0;pt<X.locationSize;pt++)S(X.location+pt,yt/X.locationSize,ht,tt,yt*vt,yt/X.locationSize*pt*vt,Ct)}}else if(W!==void 0){let tt=W[et];if(tt!==void 0)switch(tt.length){case 2:i.vertexAttrib2fv(X.location,tt);break;case 3:i.vertexAttrib3fv(X.location,tt);break;case 4:i.vertexAttrib4fv(X.location,tt);break;default:i.vertexAttrib1fv(X.location,tt)}}}}w()}function _(){N();for(let L in n){let I=n[L];for(let F in I){let k=I[F];for(let B in k){let G=k[B];for(let W in G)h(G[W].object),delete G[W];delete k[B]}}delete n[L]}}function A(L){if(n[L.id]===void 0)return;let I=n[L.id];for(let F in I){let k=I[F];for(let B in k){let G=k[B];for(let W in G)h(G[W].object),delete G[W];delete k[B]}}delete n[L.id]}function v(L){for(let I in n){let F=n[I];for(let k in F){let B=F[k];if(B[L.id]===void 0)continue;let G=B[L.id];for(let W in G)h(G[W].object),delete G[W];delete B[L.id]}}}function M(L){for(let I in n){let F=n[I],k=L.isInstancedMesh===!0?L.id:0,B=F[k];if(B!==void 0){for(let G in B){let W=B[G];for(let et in W)h(W[et].object),delete W[et];delete B[G]}delete F[k],Object.keys(F).length===0&&delete n[I]}}}function N(){C(),o=!0,r!==s&&(r=s,c(r.object))}function C(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:N,resetDefaultState:C,dispose:_,releaseStatesOfGeometry:A,releaseStatesOfObject:M,releaseStatesOfProgram:v,initAttributes:b,enableAttribute:m,disableUnusedAttributes:w}}function Gw(i,t,e){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),e.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),e.update(c,n,h))}function a(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];e.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Ww(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let v=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(v.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(v){return!(v!==je&&n.convert(v)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(v){let M=v===kn&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(v!==en&&v!==Rn&&!M&&n.convert(v)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(v){if(v==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";v="mediump"}return v==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(It("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),d=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&It("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&It("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),p=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),b=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),w=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),S=i.getParameter(i.MAX_VARYING_VECTORS),x=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),_=i.getParameter(i.MAX_SAMPLES),A=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:p,maxTextureSize:b,maxCubemapSize:m,maxAttributes:g,maxVertexUniforms:w,maxVaryings:S,maxFragmentUniforms:x,maxSamples:_,samples:A}}function $w(i){let t=this,e=null,n=0,s=!1,r=!1,o=new pn,a=new Dt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){e=h(u,d,0)},this.setState=function(u,d,f){let p=u.clippingPlanes,b=u.clipIntersection,m=u.clipShadows,g=i.get(u);if(!s||p===null||p.length===0||r&&!m)r?h(null):c();else{let w=r?0:n,S=w*4,x=g.clippingState||null;l.value=x,x=h(p,d,S,f);for(let _=0;_!==S;++_)x[_]=e[_];g.clippingState=x,this.numIntersection=b?this.numPlanes:0,this.numPlanes+=w}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(u,d,f,p){let b=u!==null?u.length:0,m=null;if(b!==0){if(m=l.value,p!==!0||m===null){let g=f+b*4,w=d.matrixWorldInverse;a.getNormalMatrix(w),(m===null||m.length<g)&&(m=new Float32Array(g));for(let S=0,x=f;S!==b;++S,x+=4)o.copy(u[S]).applyMatrix4(w,a),o.normal.toArray(m,x),m[x+3]=o.constant}l.value=m,l.needsUpdate=!0}return t.numPlanes=b,t.numIntersection=0,m}}var po=class extends Re{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new qr(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Ys(5,5,5),r=new hn({name:"CubemapFromEquirect",uniforms:xs(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:tn,blending:Qn});r.uniforms.tEquirect.value=e;let o=new Ie(s,r),a=e.minFilter;return e.minFilter===Ci&&(e.minFilter=Xe),new Js(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,n=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}},$p=256,Xw=3,qw=20,pm=256,mm=16,Yw=3,Zw=new P,Jw=new Ot,Fl=class i{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Js(1,10,null),this._boxMesh=new Ie(new Ys(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,n=.1,s=100,r={}){let{size:o=256,position:a=Zw}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,p=l.autoClearStencil,b=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,b===null&&(t.background=l.getClearColor(Jw));let m=new Js(n,s,h);return m.position.copy(a),m.update(l,t),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=p,t.background=b,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Yp(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=qp(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max($p,zp(t))}_fromTexture(t,e){t.mapping===ps||t.mapping===tr?this._setSize(t.image.length===0?$p:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let n=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(n),n}_allocateTarget(){let t=this._cubeSize,e=Xp(t,!1,!1),n=Math.log2(t)-Xw;for(let s=0;s<=n;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==e||t&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=Xp(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===ps||t.mapping===tr?(this._cubemapMaterial===null&&(this._cubemapMaterial=Yp()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=qp()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=Kw(),this._integrationMaterial=jw());let e=this._cubeSize,n=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/mm);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-Yw)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(pm*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=Qw());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,n),s.envMap.value=t.texture,this._renderCube(r,0,n)}};function Xp(i,t,e){return new po(i,{minFilter:Ci,generateMipmaps:t,type:kn,colorSpace:Or,depthBuffer:e})}function mo(i,t,e){return new hn({name:i,uniforms:t,vertexShader:Gt.cube_vert,fragmentShader:e,side:tn,blending:Qn,depthTest:!1,depthWrite:!1})}function Kw(){return mo("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${pm}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function jw(){return mo("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:mm}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Qw(){return mo("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${qw}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function qp(){return mo("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Yp(){return mo("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function t_(i){let t=new WeakMap,e=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===Ka||f===ja)if(t.has(d)){let p=t.get(d).texture;return a(p,d.mapping)}else{let p=d.image;if(p&&p.height>0){let b=new po(p.height);return b.fromEquirectangularTexture(i,d),t.set(d,b),d.addEventListener("dispose",c),a(b.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,p=f===Ka||f===ja,b=f===ps||f===tr;if(p||b){let m=e.get(d),g=m!==void 0?m.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return n===null&&(n=new Fl(i)),m=p?n.fromEquirectangular(d,m):n.fromCubemap(d,m),m.texture.pmremVersion=d.pmremVersion,e.set(d,m),m.texture;if(m!==void 0)return m.texture;{let w=d.image;return p&&w&&w.height>0||b&&w&&l(w)?(n===null&&(n=new Fl(i)),m=p?n.fromEquirectangular(d):n.fromCubemap(d),m.texture.pmremVersion=d.pmremVersion,e.set(d,m),d.addEventListener("dispose",h),m.texture):null}}}return d}function a(d,f){return f===Ka?d.mapping=ps:f===ja&&(d.mapping=tr),d}function l(d){let f=0,p=6;for(let b=0;b<p;b++)d[b]!==void 0&&f++;return f===p}function c(d){let f=d.target;f.removeEventListener("dispose",c);let p=t.get(f);p!==void 0&&(t.delete(f),p.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let p=e.get(f);p!==void 0&&(e.delete(f),p.dispose())}function u(){t=new WeakMap,e=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function e_(i){let t={};function e(n){if(t[n]!==void 0)return t[n];let s=i.getExtension(n);return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let s=e(n);return s===null&&Nr("WebGLRenderer: "+n+" extension not supported."),s}}}function n_(i,t,e,n){let s={},r=new WeakMap,o=new FinalizationRegistry(p=>delete s[p]);function a(p){l(p.target)}function l(p){p.index!==null&&t.remove(p.index);for(let m in p.attributes)t.remove(p.attributes[m]);p.removeEventListener("dispose",a),delete s[p.id],o.unregister(p);let b=r.get(p);b&&(t.remove(b),r.delete(p)),n.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,e.memory.geometries--}function c(p,b){return s[b.id]!==void 0||(b.addEventListener("dispose",a),s[b.id]=new WeakRef(b),o.register(b,b.id,b),e.memory.geometries++),b}function h(p){let b=p.attributes;for(let m in b)t.update(b[m],i.ARRAY_BUFFER)}function u(p){let b=p.index,m=p.attributes.position,g=0;if(m===void 0)return;let w=b!==null?b.array.length:m.array.length/3-1,S=m.count>=65535?Hr:Vr,x=new S(Math.ceil(w/3)*6,1),_=x.array;if(b!==null){let v=b.array;g=b.version;for(let M=0,N=0;M<w;M+=3){let C=v[M+0],L=v[M+1],I=v[M+2];_[N++]=C,_[N++]=L,_[N++]=L,_[N++]=I,_[N++]=I,_[N++]=C}}else{g=m.version;for(let v=0,M=0;v<w;v+=3){let N=v+0,C=v+1,L=v+2;_[M++]=N,_[M++]=C,_[M++]=C,_[M++]=L,_[M++]=L,_[M++]=N}}x.version=g;let A=r.get(p);A&&t.remove(A),r.set(p,x)}function d(p){let b=r.get(p);if(b){let m=p.index;m!==null&&b.version<m.version&&u(p)}else u(p);return r.get(p)}function f(){for(let p in s){let b=s[p].deref();b!==void 0&&l(b)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function i_(i,t,e){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),e.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),e.update(d,n,f))}function h(u,d,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let b=0;for(let m=0;m<f;m++)b+=d[m];e.update(b,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function s_(i){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:kt("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function r_(i,t,e){let n=new WeakMap,s=new Wt;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let N=function(){v.dispose(),n.delete(a),a.removeEventListener("dispose",N)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,b=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],w=a.morphAttributes.color||[],S=0;f===!0&&(S=1),p===!0&&(S=2),b===!0&&(S=3);let x=a.attributes.position.count*S,_=1;x>t.maxTextureSize&&(_=Math.ceil(x/t.maxTextureSize),x=t.maxTextureSize);let A=new Float32Array(x*_*4*u),v=new zr(A,x,_,u);v.type=Rn,v.needsUpdate=!0;let M=S*4;for(let C=0;C<u;C++){let L=m[C],I=g[C],F=w[C],k=x*_*4*C;for(let B=0;B<L.count;B++){let G=B*M;f===!0&&(s.fromBufferAttribute(L,B),A[k+G+0]=s.x,A[k+G+1]=s.y,A[k+G+2]=s.z,A[k+G+3]=0),p===!0&&(s.fromBufferAttribute(I,B),A[k+G+4]=s.x,A[k+G+5]=s.y,A[k+G+6]=s.z,A[k+G+7]=0),b===!0&&(s.fromBufferAttribute(F,B),A[k+G+8]=s.x,A[k+G+9]=s.y,A[k+G+10]=s.z,A[k+G+11]=F.itemSize===4?s.w:1)}}d={count:u,texture:v,size:new Et(x,_)},n.set(a,d),a.addEventListener("dispose",N)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let f=0;for(let b=0;b<c.length;b++)f+=c[b];let p=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",p),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function o_(i,t,e,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=t.get(c,u);if(r.get(d)!==h&&(t.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var a_={[jh]:"LINEAR_TONE_MAPPING",[Qh]:"REINHARD_TONE_MAPPING",[tu]:"CINEON_TONE_MAPPING",[eu]:"ACES_FILMIC_TONE_MAPPING",[iu]:"AGX_TONE_MAPPING",[su]:"NEUTRAL_TONE_MAPPING",[nu]:"CUSTOM_TONE_MAPPING"};function l_(i,t,e,n,s,r){let o=new Re(t,e,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new Le;h.setAttribute("position",new $e([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new $e([0,2,0,0,2,0],2));let u=new Oa({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new Ie(h,u),f=new Kn(-1,1,1,-1,0,1),p=null,b=null,m=!1,g,w=null,S=[],x=!1;this.setSize=function(_,A){o.setSize(_,A),a!==null&&a.setSize(_,A),l!==null&&l.setSize(_,A);for(let v=0;v<S.length;v++){let M=S[v];M.setSize&&M.setSize(_,A)}},this.setEffects=function(_){S=_,x=S.length>0&&S[0].isRenderPass===!0;let A=o.width,v=o.height;S.length>0&&a===null&&(a=new Re(A,v,{type:kn,depthBuffer:!1,stencilBuffer:!1}),l=new Re(A,v,{type:kn,depthBuffer:!1,stencilBuffer:!1}));let M=s===!0&&S.some(N=>N.needsDepthTexture===!0);M!==(o.depthTexture!==null)&&(M===!0&&c===null&&(c=new Jn(A,v),r===!0&&(c.format=Pi,c.type=ms)),o.dispose(),o.depthTexture=M?c:null,o.resolveDepthBuffer=M,o.storeMultisampledDepthBuffer=M);for(let N=0;N<S.length;N++){let C=S[N];C.setSize&&C.setSize(A,v),M&&C.needsDepthTexture===!0&&C.setDepthTexture&&C.setDepthTexture(c)}},this.begin=function(_,A){if(m||_.toneMapping===ui&&S.length===0)return!1;if(w=A,A!==null){let v=A.width,M=A.height;(o.width!==v||o.height!==M)&&this.setSize(v,M)}return x===!1&&_.setRenderTarget(o),g=_.toneMapping,_.toneMapping=ui,!0},this.hasRenderPass=function(){return x},this.end=function(_,A){_.toneMapping=g,m=!0;let v=o,M=a;for(let N=0;N<S.length;N++){let C=S[N];C.enabled!==!1&&(C.render(_,M,v,A),C.needsSwap!==!1&&(v=M,M=M===a?l:a))}if(p!==_.outputColorSpace||b!==_.toneMapping){p=_.outputColorSpace,b=_.toneMapping,u.defines={},$t.getTransfer(p)===re&&(u.defines.SRGB_TRANSFER="");let N=a_[b];N&&(u.defines[N]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=v.texture,_.setRenderTarget(w),_.render(d,f),w=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var gm=new Sn,xm=new Jn(1,1),vm=new Yr(1),ym=new zr,bm=new ka,wm=new qr,Zp=[],Jp=[],Kp=new Float32Array(16),jp=new Float32Array(9),Qp=new Float32Array(4);function ir(i,t,e){let n=i[0];if(n<=0||n>0)return i;let s=t*e,r=Zp[s];if(r===void 0&&(r=new Float32Array(s),Zp[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function Fe(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function Ue(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function zl(i,t){let e=Jp[t];e===void 0&&(e=new Int32Array(t),Jp[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function c_(i,t){let e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function h_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Fe(e,t))return;i.uniform2fv(this.addr,t),Ue(e,t)}}function u_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Fe(e,t))return;i.uniform3fv(this.addr,t),Ue(e,t)}}function d_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Fe(e,t))return;i.uniform4fv(this.addr,t),Ue(e,t)}}function f_(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Fe(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),Ue(e,t)}else{if(Fe(e,n))return;Qp.set(n),i.uniformMatrix2fv(this.addr,!1,Qp),Ue(e,n)}}function p_(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Fe(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),Ue(e,t)}else{if(Fe(e,n))return;jp.set(n),i.uniformMatrix3fv(this.addr,!1,jp),Ue(e,n)}}function m_(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Fe(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),Ue(e,t)}else{if(Fe(e,n))return;Kp.set(n),i.uniformMatrix4fv(this.addr,!1,Kp),Ue(e,n)}}function g_(i,t){let e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function x_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Fe(e,t))return;i.uniform2iv(this.addr,t),Ue(e,t)}}function v_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Fe(e,t))return;i.uniform3iv(this.addr,t),Ue(e,t)}}function y_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Fe(e,t))return;i.uniform4iv(this.addr,t),Ue(e,t)}}function b_(i,t){let e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function w_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Fe(e,t))return;i.uniform2uiv(this.addr,t),Ue(e,t)}}function __(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Fe(e,t))return;i.uniform3uiv(this.addr,t),Ue(e,t)}}function S_(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Fe(e,t))return;i.uniform4uiv(this.addr,t),Ue(e,t)}}function Vl(i){return i.version===0&&(i.compareFunction=gu,i.needsUpdate=!0),i}function M_(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=Vl(xm):r=gm,e.setTexture2D(t||r,s)}function T_(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||bm,s)}function E_(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=Vl(vm):r=wm,e.setTextureCube(t||r,s)}function A_(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||ym,s)}function C_(i){switch(i){case 5126:return c_;case 35664:return h_;case 35665:return u_;case 35666:return d_;case 35674:return f_;case 35675:return p_;case 35676:return m_;case 5124:case 35670:return g_;case 35667:case 35671:return x_;case 35668:case 35672:return v_;case 35669:case 35673:return y_;case 5125:return b_;case 36294:return w_;case 36295:return __;case 36296:return S_;case 35678:case 36198:case 36298:case 36306:case 35682:return M_;case 35679:case 36299:case 36307:return T_;case 35680:case 36300:case 36308:case 36293:return E_;case 36289:case 36303:case 36311:case 36292:return A_}}function P_(i,t){i.uniform1fv(this.addr,t)}function R_(i,t){let e=ir(t,this.size,2);i.uniform2fv(this.addr,e)}function L_(i,t){let e=ir(t,this.size,3);i.uniform3fv(this.addr,e)}function I_(i,t){let e=ir(t,this.size,4);i.uniform4fv(this.addr,e)}function k_(i,t){let e=ir(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function N_(i,t){let e=ir(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function D_(i,t){let e=ir(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function O_(i,t){i.uniform1iv(this.addr,t)}function F_(i,t){i.uniform2iv(this.addr,t)}function U_(i,t){i.uniform3iv(this.addr,t)}function B_(i,t){i.uniform4iv(this.addr,t)}function z_(i,t){i.uniform1uiv(this.addr,t)}function V_(i,t){i.uniform2uiv(this.addr,t)}function H_(i,t){i.uniform3uiv(this.addr,t)}function G_(i,t){i.uniform4uiv(this.addr,t)}function W_(i,t,e){let n=this.cache,s=t.length,r=zl(e,s);Fe(n,r)||(i.uniform1iv(this.addr,r),Ue(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=Vl(xm):o=gm;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function $_(i,t,e){let n=this.cache,s=t.length,r=zl(e,s);Fe(n,r)||(i.uniform1iv(this.addr,r),Ue(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||bm,r[o])}function X_(i,t,e){let n=this.cache,s=t.length,r=zl(e,s);Fe(n,r)||(i.uniform1iv(this.addr,r),Ue(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=Vl(vm):o=wm;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function q_(i,t,e){let n=this.cache,s=t.length,r=zl(e,s);Fe(n,r)||(i.uniform1iv(this.addr,r),Ue(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||ym,r[o])}function Y_(i){switch(i){case 5126:return P_;case 35664:return R_;case 35665:return L_;case 35666:return I_;case 35674:return k_;case 35675:return N_;case 35676:return D_;case 5124:case 35670:return O_;case 35667:case 35671:return F_;case 35668:case 35672:return U_;case 35669:case 35673:return B_;case 5125:return z_;case 36294:return V_;case 36295:return H_;case 36296:return G_;case 35678:case 36198:case 36298:case 36306:case 35682:return W_;case 35679:case 36299:case 36307:return $_;case 35680:case 36300:case 36308:case 36293:return X_;case 36289:case 36303:case 36311:case 36292:return q_}}var Eu=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=C_(e.type)}},Au=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=Y_(e.type)}},Cu=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],n)}}},Mu=/(\w+)(\])?(\[|\.)?/g;function tm(i,t){i.seq.push(t),i.map[t.id]=t}function Z_(i,t,e){let n=i.name,s=n.length;for(Mu.lastIndex=0;;){let r=Mu.exec(n),o=Mu.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){tm(e,c===void 0?new Eu(a,i,t):new Au(a,i,t));break}else{let u=e.map[a];u===void 0&&(u=new Cu(a),tm(e,u)),e=u}}}var nr=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);Z_(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,n,s){let r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){let s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){let n=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&n.push(o)}return n}};function em(i,t,e){let n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}var J_=37297,K_=0;function j_(i,t){let e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}var nm=new Dt;function Q_(i){$t._getMatrix(nm,$t.workingColorSpace,i);let t=`mat3( ${nm.elements.map(e=>e.toFixed(4))} )`;switch($t.getTransfer(i)){case Fr:return[t,"LinearTransferOETF"];case re:return[t,"sRGBTransferOETF"];default:return It("WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function im(i,t,e){let n=i.getShaderParameter(t,i.COMPILE_STATUS),r=(i.getShaderInfoLog(t)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+j_(i.getShaderSource(t),a)}else return r}function tS(i,t){let e=Q_(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var eS={[jh]:"Linear",[Qh]:"Reinhard",[tu]:"Cineon",[eu]:"ACESFilmic",[iu]:"AgX",[su]:"Neutral",[nu]:"Custom"};function nS(i,t){let e=eS[t];return e===void 0?(It("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var Ol=new P;function iS(){$t.getLuminanceCoefficients(Ol);let i=Ol.x.toFixed(4),t=Ol.y.toFixed(4),e=Ol.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function sS(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(fo).join(`
`)}function rS(i){let t=[];for(let e in i){let n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function oS(i,t){let e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(t,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function fo(i){return i!==""}function sm(i,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function rm(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var aS=/^[ \t]*#include +<([\w\d./]+)>/gm;function Pu(i){return i.replace(aS,lS)}function lS(i,t){let e=Gt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Pu(e)}var cS=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function om(i){return i.replace(cS,hS)}function hS(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function am(i){let t=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?t+=`
#define HIGH_PRECISION`:i.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var uS={[Qr]:"SHADOWMAP_TYPE_PCF",[Ks]:"SHADOWMAP_TYPE_VSM"};function dS(i){return uS[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var fS={[tr]:"ENVMAP_MODE_REFRACTION"};function pS(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":fS[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var mS={[Kh]:"ENVMAP_BLENDING_MULTIPLY",[Mp]:"ENVMAP_BLENDING_MIX",[Tp]:"ENVMAP_BLENDING_ADD"};function gS(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":mS[i.combine]||"ENVMAP_BLENDING_NONE"}function xS(i,t,e,n){let s=i.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=dS(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=pS(e),u=gS(e),d=sS(e),f=rS(r),p=s.createProgram(),b,m,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(b=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(fo).join(`
`),b.length>0&&(b+=`
`),m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(fo).join(`
`),m.length>0&&(m+=`
`)):(b=[am(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(fo).join(`
`),m=[am(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==ui?"#define TONE_MAPPING":"",e.toneMapping!==ui?Gt.tonemapping_pars_fragment:"",e.toneMapping!==ui?nS("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Gt.colorspace_pars_fragment,tS("linearToOutputTexel",e.outputColorSpace),iS(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(fo).join(`
`)),o=Pu(o),o=sm(o,e),o=rm(o,e),a=Pu(a),a=sm(a,e),a=rm(a,e),o=om(o),a=om(a),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,b=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+b,m=["#define varying in",e.glslVersion===gs?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===gs?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let w=g+b+o,S=g+m+a,x=em(s,s.VERTEX_SHADER,w),_=em(s,s.FRAGMENT_SHADER,S);s.attachShader(p,x),s.attachShader(p,_),e.index0AttributeName!==void 0?s.bindAttribLocation(p,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function A(C){if(i.debug.checkShaderErrors){let L=s.getProgramInfoLog(p)||"",I=s.getShaderInfoLog(x)||"",F=s.getShaderInfoLog(_)||"",k=L.trim(),B=I.trim(),G=F.trim(),W=!0,et=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(W=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,p,x,_);else{let X=im(s,x,"vertex"),Q=im(s,_,"fragment");kt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+C.name+`
Material Type: `+C.type+`

Program Info Log: `+k+`
`+X+`
`+Q)}else k!==""?It("WebGLProgram: Program Info Log:",k):(B===""||G==="")&&(et=!1);et&&(C.diagnostics={runnable:W,programLog:k,vertexShader:{log:B,prefix:b},fragmentShader:{log:G,prefix:m}})}s.deleteShader(x),s.deleteShader(_),v=new nr(s,p),M=oS(s,p)}let v;this.getUniforms=function(){return v===void 0&&A(this),v};let M;this.getAttributes=function(){return M===void 0&&A(this),M};let N=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return N===!1&&(N=s.getProgramParameter(p,J_)),N},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=K_++,this.cacheKey=t,this.usedTimes=1,this.program=p,this.vertexShader=x,this.fragmentShader=_,this}var vS=0,Ru=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,n){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new Lu(t),e.set(t,n)),n}},Lu=class{constructor(t){this.id=vS++,this.code=t,this.usedTimes=0}};function yS(i){return i===Yi||i===lo||i===co}function bS(i,t,e,n,s,r){let o=new Xs,a=new Ru,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(v){return l.add(v),v===0?"uv":`uv${v}`}function p(v,M,N,C,L,I){let F=C.fog,k=L.geometry,B=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?C.environment:null,G=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap,W=t.get(v.envMap||B,G),et=d[v.type],X=n.precision;v.precision!==null&&(X=n.getMaxPrecision(v.precision),X!==v.precision&&It("WebGLProgram.getParameters:",v.precision,"not supported, using",X,"instead."));let Q=k.morphAttributes.position||k.morphAttributes.normal||k.morphAttributes.color,tt=Q!==void 0?Q.length:0,yt=0;k.morphAttributes.position!==void 0&&(yt=1),k.morphAttributes.normal!==void 0&&(yt=2),k.morphAttributes.color!==void 0&&(yt=3);let Nt,J,ht,vt;if(et){let mt=fi[et];Nt=mt.vertexShader,J=mt.fragmentShader}else{Nt=v.vertexShader,J=v.fragmentShader;let mt=a.getVertexShaderStage(v),ae=a.getFragmentShaderStage(v);a.update(v,mt,ae),ht=mt.id,vt=ae.id}let Ct=i.getRenderTarget(),pt=i.state.buffers.depth.getReversed(),Ft=L.isInstancedMesh===!0,Te=L.isBatchedMesh===!0,Pt=!!v.map,jt=!!v.matcap,he=!!W,qt=he&&W.isPMREMTexture===!0,Je=!!v.aoMap,Ne=!!v.lightMap,yn=!!v.bumpMap&&v.wireframe===!1,we=!!v.normalMap,ni=!!v.displacementMap,Ve=!!v.emissiveMap,On=!!v.metalnessMap,Fn=!!v.roughnessMap,Un=v.anisotropy>0,U=v.clearcoat>0,Bn=v.diffuseRoughness>0,ve=v.dispersion>0,ye=v.retroreflectivity>0,ft=v.iridescence>0,De=v.sheen>0,Rt=v.transmission>0,Ut=Un&&!!v.anisotropyMap,R=U&&!!v.clearcoatMap,T=U&&!!v.clearcoatNormalMap,V=U&&!!v.clearcoatRoughnessMap,nt=Bn&&!!v.diffuseRoughnessMap,j=ft&&!!v.iridescenceMap,rt=ft&&!!v.iridescenceThicknessMap,ut=De&&!!v.sheenColorMap,Y=De&&!!v.sheenRoughnessMap,Z=!!v.specularMap,at=!!v.specularColorMap,D=!!v.specularIntensityMap,K=Rt&&!!v.transmissionMap,q=Rt&&!!v.thicknessMap,lt=!!v.gradientMap,st=!!v.alphaMap,ot=v.alphaTest>0,Tt=!!v.alphaHash,Ht=!!v.extensions,it=ui;v.toneMapped&&(Ct===null||Ct.isXRRenderTarget===!0)&&(it=i.toneMapping);let At=qt?W.isCompressedCubeTexture?W.image[0].mipmaps:W.mipmaps:null,zt={shaderID:et,shaderType:v.type,shaderName:v.name,vertexShader:Nt,fragmentShader:J,defines:v.defines,customVertexShaderID:ht,customFragmentShaderID:vt,isRawShaderMaterial:v.isRawShaderMaterial===!0,glslVersion:v.glslVersion,precision:X,batching:Te,batchingColor:Te&&L._colorsTexture!==null,instancing:Ft,instancingColor:Ft&&L.instanceColor!==null,instancingMorph:Ft&&L.morphTexture!==null,outputColorSpace:Ct===null?i.outputColorSpace:Ct.isXRRenderTarget===!0?Ct.texture.colorSpace:$t.workingColorSpace,alphaToCoverage:!!v.alphaToCoverage,map:Pt,matcap:jt,envMap:he,envMapMode:he&&W.mapping,envMapPMREM:qt,envMapMaxLod:qt?At.length-1:null,envMapSize:qt?At[0].width:null,aoMap:Je,lightMap:Ne,bumpMap:yn,normalMap:we,displacementMap:ni,emissiveMap:Ve,normalMapObjectSpace:we&&v.normalMapType===Cp,normalMapTangentSpace:we&&v.normalMapType===fu,packedNormalMap:we&&v.normalMapType===fu&&yS(v.normalMap.format),metalnessMap:On,roughnessMap:Fn,anisotropy:Un,anisotropyMap:Ut,clearcoat:U,clearcoatMap:R,clearcoatNormalMap:T,clearcoatRoughnessMap:V,diffuseRoughness:Bn,diffuseRoughnessMap:nt,dispersion:ve,retroreflection:ye,iridescence:ft,iridescenceMap:j,iridescenceThicknessMap:rt,sheen:De,sheenColorMap:ut,sheenRoughnessMap:Y,specularMap:Z,specularColorMap:at,specularIntensityMap:D,transmission:Rt,transmissionMap:K,thicknessMap:q,gradientMap:lt,opaque:v.transparent===!1&&v.blending===js&&v.alphaToCoverage===!1,alphaMap:st,alphaTest:ot,alphaHash:Tt,combine:v.combine,mapUv:Pt&&f(v.map.channel),aoMapUv:Je&&f(v.aoMap.channel),lightMapUv:Ne&&f(v.lightMap.channel),bumpMapUv:yn&&f(v.bumpMap.channel),normalMapUv:we&&f(v.normalMap.channel),displacementMapUv:ni&&f(v.displacementMap.channel),emissiveMapUv:Ve&&f(v.emissiveMap.channel),metalnessMapUv:On&&f(v.metalnessMap.channel),roughnessMapUv:Fn&&f(v.roughnessMap.channel),anisotropyMapUv:Ut&&f(v.anisotropyMap.channel),clearcoatMapUv:R&&f(v.clearcoatMap.channel),clearcoatNormalMapUv:T&&f(v.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:V&&f(v.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:nt&&f(v.diffuseRoughnessMap.channel),iridescenceMapUv:j&&f(v.iridescenceMap.channel),iridescenceThicknessMapUv:rt&&f(v.iridescenceThicknessMap.channel),sheenColorMapUv:ut&&f(v.sheenColorMap.channel),sheenRoughnessMapUv:Y&&f(v.sheenRoughnessMap.channel),specularMapUv:Z&&f(v.specularMap.channel),specularColorMapUv:at&&f(v.specularColorMap.channel),specularIntensityMapUv:D&&f(v.specularIntensityMap.channel),transmissionMapUv:K&&f(v.transmissionMap.channel),thicknessMapUv:q&&f(v.thicknessMap.channel),alphaMapUv:st&&f(v.alphaMap.channel),vertexTangents:!!k.attributes.tangent&&(we||Un),vertexNormals:!!k.attributes.normal,vertexColors:v.vertexColors,vertexAlphas:v.vertexColors===!0&&!!k.attributes.color&&k.attributes.color.itemSize===4,pointsUvs:L.isPoints===!0&&!!k.attributes.uv&&(Pt||st),fog:!!F,useFog:v.fog===!0,fogExp2:!!F&&F.isFogExp2,flatShading:v.wireframe===!1&&(v.flatShading===!0||k.attributes.normal===void 0&&we===!1&&(v.isMeshLambertMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isMeshPhysicalMaterial)),sizeAttenuation:v.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:pt,skinning:L.isSkinnedMesh===!0,hasPositionAttribute:k.attributes.position!==void 0,morphTargets:k.morphAttributes.position!==void 0,morphNormals:k.morphAttributes.normal!==void 0,morphColors:k.morphAttributes.color!==void 0,morphTargetsCount:tt,morphTextureStride:yt,numSunLights:M.sun.length,numDirLights:M.directional.length,numPointLights:M.point.length,numSpotLights:M.spot.length,numSpotLightMaps:M.spotLightMap.length,numRectAreaLights:M.rectArea.length,numHemiLights:M.hemi.length,numSunLightShadows:M.sunShadowMap.length,numDirLightShadows:M.directionalShadowMap.length,numPointLightShadows:M.pointShadowMap.length,numSpotLightShadows:M.spotShadowMap.length,numSpotLightShadowsWithMaps:M.numSpotLightShadowsWithMaps,numLightProbes:M.numLightProbes,numLightProbeGrids:I.filter(mt=>mt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:v.dithering,shadowMapEnabled:i.shadowMap.enabled&&N.length>0,shadowMapType:i.shadowMap.type,toneMapping:it,decodeVideoTexture:Pt&&v.map.isVideoTexture===!0&&$t.getTransfer(v.map.colorSpace)===re,decodeVideoTextureEmissive:Ve&&v.emissiveMap.isVideoTexture===!0&&$t.getTransfer(v.emissiveMap.colorSpace)===re,premultipliedAlpha:v.premultipliedAlpha,doubleSided:v.side===Oe,flipSided:v.side===tn,useDepthPacking:v.depthPacking>=0,depthPacking:v.depthPacking||0,index0AttributeName:v.index0AttributeName,extensionClipCullDistance:Ht&&v.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Ht&&v.extensions.multiDraw===!0||Te)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:v.customProgramCacheKey()};return zt.vertexUv1s=l.has(1),zt.vertexUv2s=l.has(2),zt.vertexUv3s=l.has(3),l.clear(),zt}function b(v){let M=[];if(v.shaderID?M.push(v.shaderID):(M.push(v.customVertexShaderID),M.push(v.customFragmentShaderID)),v.defines!==void 0)for(let N in v.defines)M.push(N),M.push(v.defines[N]);return v.isRawShaderMaterial===!1&&(m(M,v),g(M,v),M.push(i.outputColorSpace)),M.push(v.customProgramCacheKey),M.join()}function m(v,M){v.push(M.precision),v.push(M.outputColorSpace),v.push(M.envMapMode),v.push(M.envMapPMREM),v.push(M.envMapMaxLod),v.push(M.envMapSize),v.push(M.mapUv),v.push(M.alphaMapUv),v.push(M.lightMapUv),v.push(M.aoMapUv),v.push(M.bumpMapUv),v.push(M.normalMapUv),v.push(M.displacementMapUv),v.push(M.emissiveMapUv),v.push(M.metalnessMapUv),v.push(M.roughnessMapUv),v.push(M.anisotropyMapUv),v.push(M.clearcoatMapUv),v.push(M.clearcoatNormalMapUv),v.push(M.clearcoatRoughnessMapUv),v.push(M.diffuseRoughnessMapUv),v.push(M.iridescenceMapUv),v.push(M.iridescenceThicknessMapUv),v.push(M.sheenColorMapUv),v.push(M.sheenRoughnessMapUv),v.push(M.specularMapUv),v.push(M.specularColorMapUv),v.push(M.specularIntensityMapUv),v.push(M.transmissionMapUv),v.push(M.thicknessMapUv),v.push(M.combine),v.push(M.fogExp2),v.push(M.sizeAttenuation),v.push(M.morphTargetsCount),v.push(M.numSunLights),v.push(M.numDirLights),v.push(M.numPointLights),v.push(M.numSpotLights),v.push(M.numSpotLightMaps),v.push(M.numHemiLights),v.push(M.numRectAreaLights),v.push(M.numSunLightShadows),v.push(M.numDirLightShadows),v.push(M.numPointLightShadows),v.push(M.numSpotLightShadows),v.push(M.numSpotLightShadowsWithMaps),v.push(M.numLightProbes),v.push(M.numLightProbeGrids),v.push(M.shadowMapType),v.push(M.toneMapping),v.push(M.numClippingPlanes),v.push(M.numClipIntersection),v.push(M.depthPacking)}function g(v,M){o.disableAll(),M.instancing&&o.enable(0),M.instancingColor&&o.enable(1),M.instancingMorph&&o.enable(2),M.matcap&&o.enable(3),M.envMap&&o.enable(4),M.normalMapObjectSpace&&o.enable(5),M.normalMapTangentSpace&&o.enable(6),M.clearcoat&&o.enable(7),M.iridescence&&o.enable(8),M.alphaTest&&o.enable(9),M.vertexColors&&o.enable(10),M.vertexAlphas&&o.enable(11),M.vertexUv1s&&o.enable(12),M.vertexUv2s&&o.enable(13),M.vertexUv3s&&o.enable(14),M.vertexTangents&&o.enable(15),M.anisotropy&&o.enable(16),M.alphaHash&&o.enable(17),M.batching&&o.enable(18),M.dispersion&&o.enable(19),M.retroreflection&&o.enable(24),M.diffuseRoughness&&o.enable(25),M.batchingColor&&o.enable(20),M.gradientMap&&o.enable(21),M.packedNormalMap&&o.enable(22),M.vertexNormals&&o.enable(23),v.push(o.mask),o.disableAll(),M.fog&&o.enable(0),M.useFog&&o.enable(1),M.flatShading&&o.enable(2),M.logarithmicDepthBuffer&&o.enable(3),M.reversedDepthBuffer&&o.enable(4),M.skinning&&o.enable(5),M.morphTargets&&o.enable(6),M.morphNormals&&o.enable(7),M.morphColors&&o.enable(8),M.premultipliedAlpha&&o.enable(9),M.shadowMapEnabled&&o.enable(10),M.doubleSided&&o.enable(11),M.flipSided&&o.enable(12),M.useDepthPacking&&o.enable(13),M.dithering&&o.enable(14),M.transmission&&o.enable(15),M.sheen&&o.enable(16),M.opaque&&o.enable(17),M.pointsUvs&&o.enable(18),M.decodeVideoTexture&&o.enable(19),M.decodeVideoTextureEmissive&&o.enable(20),M.alphaToCoverage&&o.enable(21),M.numLightProbeGrids>0&&o.enable(22),M.hasPositionAttribute&&o.enable(23),v.push(o.mask)}function w(v){let M=d[v.type],N;if(M){let C=fi[M];N=Hp.clone(C.uniforms)}else N=v.uniforms;return N}function S(v,M){let N=h.get(M);return N!==void 0?++N.usedTimes:(N=new xS(i,M,v,s),c.push(N),h.set(M,N)),N}function x(v){if(--v.usedTimes===0){let M=c.indexOf(v);c[M]=c[c.length-1],c.pop(),h.delete(v.cacheKey),v.destroy()}}function _(v){a.remove(v)}function A(){a.dispose()}return{getParameters:p,getProgramCacheKey:b,getUniforms:w,acquireProgram:S,releaseProgram:x,releaseShaderCache:_,programs:c,dispose:A}}function wS(){let i=new WeakMap;function t(o){return i.has(o)}function e(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function _S(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.materialVariant!==t.materialVariant?i.materialVariant-t.materialVariant:i.z!==t.z?i.z-t.z:i.id-t.id}function lm(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function cm(){let i=[],t=0,e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,p,b,m,g){let w=i[t];return w===void 0?(w={id:d.id,object:d,geometry:f,material:p,materialVariant:o(d),groupOrder:b,renderOrder:d.renderOrder,z:m,group:g},i[t]=w):(w.id=d.id,w.object=d,w.geometry=f,w.material=p,w.materialVariant=o(d),w.groupOrder=b,w.renderOrder=d.renderOrder,w.z=m,w.group=g),t++,w}function l(d,f,p,b,m,g,w){w.reversedDepth===!0&&(m=-m);let S=a(d,f,p,b,m,g);p.transmission>0?n.push(S):p.transparent===!0?s.push(S):e.push(S)}function c(d,f,p,b,m,g){let w=a(d,f,p,b,m,g);p.transmission>0?n.unshift(w):p.transparent===!0?s.unshift(w):e.unshift(w)}function h(d,f){e.length>1&&e.sort(d||_S),n.length>1&&n.sort(f||lm),s.length>1&&s.sort(f||lm)}function u(){for(let d=t,f=i.length;d<f;d++){let p=i[d];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function SS(){let i=new WeakMap;function t(n,s){let r=i.get(n),o;return r===void 0?(o=new cm,i.set(n,[o])):s>=r.length?(o=new cm,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function MS(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new P,color:new Ot};break;case"SpotLight":e={position:new P,direction:new P,color:new Ot,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new P,color:new Ot,distance:0,decay:0};break;case"HemisphereLight":e={direction:new P,skyColor:new Ot,groundColor:new Ot};break;case"RectAreaLight":e={color:new Ot,position:new P,halfWidth:new P,halfHeight:new P};break}return i[t.id]=e,e}}}function TS(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Et};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Et};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Et,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}var ES=0;function AS(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function CS(i){let t=new MS,e=TS(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new P);let s=new P,r=new Mt,o=new Mt;function a(c){let h=0,u=0,d=0;for(let I=0;I<9;I++)n.probe[I].set(0,0,0);let f=0,p=0,b=0,m=0,g=0,w=0,S=0,x=0,_=0,A=0,v=0,M=0,N=0,C=0;c.sort(AS);for(let I=0,F=c.length;I<F;I++){let k=c[I],B=k.color,G=k.intensity,W=k.distance,et=null;if(k.shadow&&k.shadow.map&&(k.shadow.map.texture.format===Yi?et=k.shadow.map.texture:et=k.shadow.map.depthTexture||k.shadow.map.texture),k.isAmbientLight)h+=B.r*G,u+=B.g*G,d+=B.b*G;else if(k.isLightProbe){for(let X=0;X<9;X++)n.probe[X].addScaledVector(k.sh.coefficients[X],G);C++}else if(k.isSunLight){let X=t.get(k);if(X.color.copy(k.color).multiplyScalar(k.intensity),k.castShadow){let Q=k.shadow,tt=e.get(k);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),n.sunShadow[p]=tt,n.sunShadowMap[p]=et;let yt=Q.getViewportCount();for(let Nt=0;Nt<yt;Nt++)n.sunShadowMatrix[b+Nt]=Q.getMatrix(Nt),n.sunShadowCascade[b+Nt]=Q._cascadeData[Nt];b+=yt,p++}n.sun[f]=X,f++}else if(k.isDirectionalLight){let X=t.get(k);if(X.color.copy(k.color).multiplyScalar(k.intensity),k.castShadow){let Q=k.shadow,tt=e.get(k);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize=Q.mapSize,n.directionalShadow[m]=tt,n.directionalShadowMap[m]=et,n.directionalShadowMatrix[m]=k.shadow.matrix,_++}n.directional[m]=X,m++}else if(k.isSpotLight){let X=t.get(k);X.position.setFromMatrixPosition(k.matrixWorld),X.color.copy(B).multiplyScalar(G),X.distance=W,X.coneCos=Math.cos(k.angle),X.penumbraCos=Math.cos(k.angle*(1-k.penumbra)),X.decay=k.decay,n.spot[w]=X;let Q=k.shadow;if(k.map&&(n.spotLightMap[M]=k.map,M++,Q.updateMatrices(k),k.castShadow&&N++),n.spotLightMatrix[w]=Q.matrix,k.castShadow){let tt=e.get(k);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize=Q.mapSize,n.spotShadow[w]=tt,n.spotShadowMap[w]=et,v++}w++}else if(k.isRectAreaLight){let X=t.get(k);X.color.copy(B).multiplyScalar(G),X.halfWidth.set(k.width*.5,0,0),X.halfHeight.set(0,k.height*.5,0),n.rectArea[S]=X,S++}else if(k.isPointLight){let X=t.get(k);if(X.color.copy(k.color).multiplyScalar(k.intensity),X.distance=k.distance,X.decay=k.decay,k.castShadow){let Q=k.shadow,tt=e.get(k);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize=Q.mapSize,tt.shadowCameraNear=Q.camera.near,tt.shadowCameraFar=Q.camera.far,n.pointShadow[g]=tt,n.pointShadowMap[g]=et,n.pointShadowMatrix[g]=k.shadow.matrix,A++}n.point[g]=X,g++}else if(k.isHemisphereLight){let X=t.get(k);X.skyColor.copy(k.color).multiplyScalar(G),X.groundColor.copy(k.groundColor).multiplyScalar(G),n.hemi[x]=X,x++}}S>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=gt.LTC_FLOAT_1,n.rectAreaLTC2=gt.LTC_FLOAT_2):(n.rectAreaLTC1=gt.LTC_HALF_1,n.rectAreaLTC2=gt.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let L=n.hash;(L.sunLength!==f||L.directionalLength!==m||L.pointLength!==g||L.spotLength!==w||L.rectAreaLength!==S||L.hemiLength!==x||L.numSunShadows!==p||L.numDirectionalShadows!==_||L.numPointShadows!==A||L.numSpotShadows!==v||L.numSpotMaps!==M||L.numLightProbes!==C)&&(n.sun.length=f,n.directional.length=m,n.spot.length=w,n.rectArea.length=S,n.point.length=g,n.hemi.length=x,n.sunShadow.length=p,n.sunShadowMap.length=p,n.sunShadowMatrix.length=b,n.sunShadowCascade.length=b,n.directionalShadow.length=_,n.directionalShadowMap.length=_,n.directionalShadowMatrix.length=_,n.pointShadow.length=A,n.pointShadowMap.length=A,n.pointShadowMatrix.length=A,n.spotShadow.length=v,n.spotShadowMap.length=v,n.spotLightMatrix.length=v+M-N,n.spotLightMap.length=M,n.numSpotLightShadowsWithMaps=N,n.numLightProbes=C,L.sunLength=f,L.directionalLength=m,L.pointLength=g,L.spotLength=w,L.rectAreaLength=S,L.hemiLength=x,L.numSunShadows=p,L.numDirectionalShadows=_,L.numPointShadows=A,L.numSpotShadows=v,L.numSpotMaps=M,L.numLightProbes=C,n.version=ES++)}function l(c,h){let u=0,d=0,f=0,p=0,b=0,m=0,g=h.matrixWorldInverse;for(let w=0,S=c.length;w<S;w++){let x=c[w];if(x.isSunLight){let _=n.sun[u];_.direction.setFromMatrixPosition(x.matrixWorld),_.direction.transformDirection(g),u++}else if(x.isDirectionalLight){let _=n.directional[d];_.direction.setFromMatrixPosition(x.matrixWorld),s.setFromMatrixPosition(x.target.matrixWorld),_.direction.sub(s),_.direction.transformDirection(g),d++}else if(x.isSpotLight){let _=n.spot[p];_.position.setFromMatrixPosition(x.matrixWorld),_.position.applyMatrix4(g),_.direction.setFromMatrixPosition(x.matrixWorld),s.setFromMatrixPosition(x.target.matrixWorld),_.direction.sub(s),_.direction.transformDirection(g),p++}else if(x.isRectAreaLight){let _=n.rectArea[b];_.position.setFromMatrixPosition(x.matrixWorld),_.position.applyMatrix4(g),o.identity(),r.copy(x.matrixWorld),r.premultiply(g),o.extractRotation(r),_.halfWidth.set(x.width*.5,0,0),_.halfHeight.set(0,x.height*.5,0),_.halfWidth.applyMatrix4(o),_.halfHeight.applyMatrix4(o),b++}else if(x.isPointLight){let _=n.point[f];_.position.setFromMatrixPosition(x.matrixWorld),_.position.applyMatrix4(g),f++}else if(x.isHemisphereLight){let _=n.hemi[m];_.direction.setFromMatrixPosition(x.matrixWorld),_.direction.transformDirection(g),m++}}}return{setup:a,setupView:l,state:n}}function hm(i){let t=new CS(i),e=[],n=[],s=[];function r(u){h.camera=u,e.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){n.push(u)}function l(){t.setup(e),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function PS(i){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new hm(i),t.set(s,[a])):r>=o.length?(a=new hm(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}var RS=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,LS=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,IS=[new P(1,0,0),new P(-1,0,0),new P(0,1,0),new P(0,-1,0),new P(0,0,1),new P(0,0,-1)],kS=[new P(0,-1,0),new P(0,-1,0),new P(0,0,1),new P(0,0,-1),new P(0,-1,0),new P(0,-1,0)],um=new Mt,uo=new P,Tu=new P;function NS(i,t,e){let n=new hi,s=new Et,r=new Et,o=new Wt,a=new Fa,l=new Ua,c={},h=e.maxTextureSize,u={[jn]:tn,[tn]:jn,[Oe]:Oe},d=new hn({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Et},radius:{value:4}},vertexShader:RS,fragmentShader:LS}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let p=new Le;p.setAttribute("position",new be(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let b=new Ie(p,d),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Qr;let g=this.type;this.render=function(A,v,M){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||A.length===0)return;this.type===ap&&(It("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Qr);let N=i.getRenderTarget(),C=i.getActiveCubeFace(),L=i.getActiveMipmapLevel(),I=i.state;I.setBlending(Qn),I.buffers.depth.getReversed()===!0?I.buffers.color.setClear(0,0,0,0):I.buffers.color.setClear(1,1,1,1),I.buffers.depth.setTest(!0),I.setScissorTest(!1);let F=g!==this.type;F&&v.traverse(function(k){k.material&&(Array.isArray(k.material)?k.material.forEach(B=>B.needsUpdate=!0):k.material.needsUpdate=!0)});for(let k=0,B=A.length;k<B;k++){let G=A[k],W=G.shadow;if(W===void 0){It("WebGLShadowMap:",G,"has no shadow.");continue}if(W.autoUpdate===!1&&W.needsUpdate===!1)continue;s.copy(W.mapSize);let et=W.getFrameExtents();s.multiply(et),r.copy(W.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/et.x),s.x=r.x*et.x,W.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/et.y),s.y=r.y*et.y,W.mapSize.y=r.y));let X=i.state.buffers.depth.getReversed();if(W.camera._reversedDepth=X,W.map===null||F===!0){if(W.map!==null&&(W.map.depthTexture!==null&&(W.map.depthTexture.dispose(),W.map.depthTexture=null),W.map.dispose()),this.type===Ks){if(G.isPointLight){It("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}W.map=new Re(s.x,s.y,{format:Yi,type:kn,minFilter:Xe,magFilter:Xe,generateMipmaps:!1}),W.map.texture.name=G.name+".shadowMap",W.map.depthTexture=new Jn(s.x,s.y,Rn),W.map.depthTexture.name=G.name+".shadowMapDepth",W.map.depthTexture.format=Ei,W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=Se,W.map.depthTexture.magFilter=Se}else G.isPointLight?(W.map=new po(s.x),W.map.depthTexture=new Yr(s.x,Mn)):(W.map=new Re(s.x,s.y),W.map.depthTexture=new Jn(s.x,s.y,Mn)),W.map.depthTexture.name=G.name+".shadowMap",W.map.depthTexture.format=Ei,this.type===Qr?(W.map.depthTexture.compareFunction=X?mu:pu,W.map.depthTexture.minFilter=Xe,W.map.depthTexture.magFilter=Xe):(W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=Se,W.map.depthTexture.magFilter=Se);W.camera.updateProjectionMatrix()}W.map.isWebGLCubeRenderTarget!==!0&&(W.map.width!==s.x||W.map.height!==s.y)&&W.map.setSize(s.x,s.y);let Q=W.map.isWebGLCubeRenderTarget?6:W.getViewportCount();G.isPointLight!==!0&&W.updateMatrices(G,M);let tt=(W.camera.layers.mask&4294967294)!==0?W.camera.layers:M.layers;for(let yt=0;yt<Q;yt++){let Nt=W.getCamera(yt);if(G.isPointLight){let J=W.camera,ht=W.matrix,vt=G.distance||J.far;vt!==J.far&&(J.far=vt,J.updateProjectionMatrix()),uo.setFromMatrixPosition(G.matrixWorld),J.position.copy(uo),Tu.copy(J.position),Tu.add(IS[yt]),J.up.copy(kS[yt]),J.lookAt(Tu),J.updateMatrixWorld(),ht.makeTranslation(-uo.x,-uo.y,-uo.z),um.multiplyMatrices(J.projectionMatrix,J.matrixWorldInverse),W._frustum.setFromProjectionMatrix(um,J.coordinateSystem,J.reversedDepth)}if(W.map.isWebGLCubeRenderTarget)i.setRenderTarget(W.map,yt),i.clear();else{yt===0&&(i.setRenderTarget(W.map),i.clear());let J=W.getViewport(yt);o.set(r.x*J.x,r.y*J.y,r.x*J.z,r.y*J.w),I.viewport(o)}n=W.getFrustum(yt),x(v,M,Nt,G,tt,this.type)}W.isPointLightShadow!==!0&&this.type===Ks&&w(W,M),W.needsUpdate=!1}g=this.type,m.needsUpdate=!1,i.setRenderTarget(N,C,L)};function w(A,v){let M=t.update(b);d.defines.VSM_SAMPLES!==A.blurSamples&&(d.defines.VSM_SAMPLES=A.blurSamples,f.defines.VSM_SAMPLES=A.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),A.mapPass===null?A.mapPass=new Re(s.x,s.y,{format:Yi,type:kn}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),d.uniforms.shadow_pass.value=A.map.depthTexture,d.uniforms.resolution.value.set(A.map.width,A.map.height),d.uniforms.radius.value=A.radius,i.setRenderTarget(A.mapPass),i.clear(),i.renderBufferDirect(v,null,M,d,b,null),f.uniforms.shadow_pass.value=A.mapPass.texture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,i.setRenderTarget(A.map),i.clear(),i.renderBufferDirect(v,null,M,f,b,null)}function S(A,v,M,N){let C=null,L=M.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(L!==void 0)C=L;else if(C=M.isPointLight===!0?l:a,i.localClippingEnabled&&v.clipShadows===!0&&Array.isArray(v.clippingPlanes)&&v.clippingPlanes.length!==0||v.displacementMap&&v.displacementScale!==0||v.alphaMap&&v.alphaTest>0||v.map&&v.alphaTest>0||v.alphaToCoverage===!0){let I=C.uuid,F=v.uuid,k=c[I];k===void 0&&(k={},c[I]=k);let B=k[F];B===void 0&&(B=C.clone(),k[F]=B,v.addEventListener("dispose",_)),C=B}if(C.visible=v.visible,C.wireframe=v.wireframe,N===Ks?C.side=v.shadowSide!==null?v.shadowSide:v.side:C.side=v.shadowSide!==null?v.shadowSide:u[v.side],C.alphaMap=v.alphaMap,C.alphaTest=v.alphaToCoverage===!0?.5:v.alphaTest,C.map=v.map,C.clipShadows=v.clipShadows,C.clippingPlanes=v.clippingPlanes,C.clipIntersection=v.clipIntersection,C.displacementMap=v.displacementMap,C.displacementScale=v.displacementScale,C.displacementBias=v.displacementBias,C.wireframeLinewidth=v.wireframeLinewidth,C.linewidth=v.linewidth,M.isPointLight===!0&&C.isMeshDistanceMaterial===!0){let I=i.properties.get(C);I.light=M}return C}function x(A,v,M,N,C,L){if(A.visible===!1)return;if(A.layers.test(C)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&L===Ks)&&(!A.frustumCulled||A.intersectsFrustum(n))){A.modelViewMatrix.multiplyMatrices(M.matrixWorldInverse,A.matrixWorld);let k=t.update(A),B=A.material;if(Array.isArray(B)){let G=k.groups;for(let W=0,et=G.length;W<et;W++){let X=G[W],Q=B[X.materialIndex];if(Q&&Q.visible){let tt=S(A,Q,N,L);A.onBeforeShadow(i,A,v,M,k,tt,X),i.renderBufferDirect(M,null,k,tt,A,X),A.onAfterShadow(i,A,v,M,k,tt,X)}}}else if(B.visible){let G=S(A,B,N,L);A.onBeforeShadow(i,A,v,M,k,G,null),i.renderBufferDirect(M,null,k,G,A,null),A.onAfterShadow(i,A,v,M,k,G,null)}}let F=A.children;for(let k=0,B=F.length;k<B;k++)x(F[k],v,M,N,C,L)}function _(A){A.target.removeEventListener("dispose",_);for(let M in c){let N=c[M],C=A.target.uuid;C in N&&(N[C].dispose(),delete N[C])}}}function DS(i,t){function e(){let D=!1,K=new Wt,q=null,lt=new Wt(0,0,0,0);return{setMask:function(st){q!==st&&!D&&(i.colorMask(st,st,st,st),q=st)},setLocked:function(st){D=st},setClear:function(st,ot,Tt,Ht,it){it===!0&&(st*=Ht,ot*=Ht,Tt*=Ht),K.set(st,ot,Tt,Ht),lt.equals(K)===!1&&(i.clearColor(st,ot,Tt,Ht),lt.copy(K))},reset:function(){D=!1,q=null,lt.set(-1,0,0,0)}}}function n(){let D=!1,K=!1,q=null,lt=null,st=null;return{setReversed:function(ot){if(K!==ot){let Tt=t.get("EXT_clip_control");ot?Tt.clipControlEXT(Tt.LOWER_LEFT_EXT,Tt.ZERO_TO_ONE_EXT):Tt.clipControlEXT(Tt.LOWER_LEFT_EXT,Tt.NEGATIVE_ONE_TO_ONE_EXT),K=ot;let Ht=st;st=null,this.setClear(Ht)}},getReversed:function(){return K},setTest:function(ot){ot?pt(i.DEPTH_TEST):Ft(i.DEPTH_TEST)},setMask:function(ot){q!==ot&&!D&&(i.depthMask(ot),q=ot)},setFunc:function(ot){if(K&&(ot=Bp[ot]),lt!==ot){switch(ot){case ba:i.depthFunc(i.NEVER);break;case wa:i.depthFunc(i.ALWAYS);break;case _a:i.depthFunc(i.LESS);break;case Gs:i.depthFunc(i.LEQUAL);break;case Sa:i.depthFunc(i.EQUAL);break;case Ma:i.depthFunc(i.GEQUAL);break;case Ta:i.depthFunc(i.GREATER);break;case Ea:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}lt=ot}},setLocked:function(ot){D=ot},setClear:function(ot){st!==ot&&(st=ot,K&&(ot=1-ot),i.clearDepth(ot))},reset:function(){D=!1,q=null,lt=null,st=null,K=!1}}}function s(){let D=!1,K=null,q=null,lt=null,st=null,ot=null,Tt=null,Ht=null,it=null;return{setTest:function(At){D||(At?pt(i.STENCIL_TEST):Ft(i.STENCIL_TEST))},setMask:function(At){K!==At&&!D&&(i.stencilMask(At),K=At)},setFunc:function(At,zt,mt){(q!==At||lt!==zt||st!==mt)&&(i.stencilFunc(At,zt,mt),q=At,lt=zt,st=mt)},setOp:function(At,zt,mt){(ot!==At||Tt!==zt||Ht!==mt)&&(i.stencilOp(At,zt,mt),ot=At,Tt=zt,Ht=mt)},setLocked:function(At){D=At},setClear:function(At){it!==At&&(i.clearStencil(At),it=At)},reset:function(){D=!1,K=null,q=null,lt=null,st=null,ot=null,Tt=null,Ht=null,it=null}}}let r=new e,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,p=[],b=null,m=!1,g=null,w=null,S=null,x=null,_=null,A=null,v=null,M=new Ot(0,0,0),N=0,C=!1,L=null,I=null,F=null,k=null,B=null,G=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),W=!1,et=0,X=i.getParameter(i.VERSION);X.indexOf("WebGL")!==-1?(et=parseFloat(/^WebGL (\d)/.exec(X)[1]),W=et>=1):X.indexOf("OpenGL ES")!==-1&&(et=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),W=et>=2);let Q=null,tt={},yt=i.getParameter(i.SCISSOR_BOX),Nt=i.getParameter(i.VIEWPORT),J=new Wt().fromArray(yt),ht=new Wt().fromArray(Nt);function vt(D,K,q,lt){let st=new Uint8Array(4),ot=i.createTexture();i.bindTexture(D,ot),i.texParameteri(D,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(D,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Tt=0;Tt<q;Tt++)D===i.TEXTURE_3D||D===i.TEXTURE_2D_ARRAY?i.texImage3D(K,0,i.RGBA,1,1,lt,0,i.RGBA,i.UNSIGNED_BYTE,st):i.texImage2D(K+Tt,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,st);return ot}let Ct={};Ct[i.TEXTURE_2D]=vt(i.TEXTURE_2D,i.TEXTURE_2D,1),Ct[i.TEXTURE_CUBE_MAP]=vt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ct[i.TEXTURE_2D_ARRAY]=vt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Ct[i.TEXTURE_3D]=vt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),pt(i.DEPTH_TEST),o.setFunc(Gs),yn(!1),we(qh),pt(i.CULL_FACE),Je(Qn);function pt(D){h[D]!==!0&&(i.enable(D),h[D]=!0)}function Ft(D){h[D]!==!1&&(i.disable(D),h[D]=!1)}function Te(D,K){return d[D]!==K?(i.bindFramebuffer(D,K),d[D]=K,D===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=K),D===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=K),!0):!1}function Pt(D,K){let q=p,lt=!1;if(D){q=f.get(K),q===void 0&&(q=[],f.set(K,q));let st=D.textures;if(q.length!==st.length||q[0]!==i.COLOR_ATTACHMENT0){for(let ot=0,Tt=st.length;ot<Tt;ot++)q[ot]=i.COLOR_ATTACHMENT0+ot;q.length=st.length,lt=!0}}else q[0]!==i.BACK&&(q[0]=i.BACK,lt=!0);lt&&i.drawBuffers(q)}function jt(D){return b!==D?(i.useProgram(D),b=D,!0):!1}let he={[fs]:i.FUNC_ADD,[lp]:i.FUNC_SUBTRACT,[cp]:i.FUNC_REVERSE_SUBTRACT};he[hp]=i.MIN,he[up]=i.MAX;let qt={[dp]:i.ZERO,[Ja]:i.ONE,[fp]:i.SRC_COLOR,[eo]:i.SRC_ALPHA,[yp]:i.SRC_ALPHA_SATURATE,[xp]:i.DST_COLOR,[mp]:i.DST_ALPHA,[pp]:i.ONE_MINUS_SRC_COLOR,[Qs]:i.ONE_MINUS_SRC_ALPHA,[vp]:i.ONE_MINUS_DST_COLOR,[gp]:i.ONE_MINUS_DST_ALPHA,[bp]:i.CONSTANT_COLOR,[wp]:i.ONE_MINUS_CONSTANT_COLOR,[_p]:i.CONSTANT_ALPHA,[Sp]:i.ONE_MINUS_CONSTANT_ALPHA};function Je(D,K,q,lt,st,ot,Tt,Ht,it,At){if(D===Qn){m===!0&&(Ft(i.BLEND),m=!1);return}if(m===!1&&(pt(i.BLEND),m=!0),D!==to){if(D!==g||At!==C){if((w!==fs||_!==fs)&&(i.blendEquation(i.FUNC_ADD),w=fs,_=fs),At)switch(D){case js:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Yh:i.blendFunc(i.ONE,i.ONE);break;case Zh:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Jh:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:kt("WebGLState: Invalid blending: ",D);break}else switch(D){case js:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Yh:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Zh:kt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Jh:kt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:kt("WebGLState: Invalid blending: ",D);break}S=null,x=null,A=null,v=null,M.set(0,0,0),N=0,g=D,C=At}return}st=st||K,ot=ot||q,Tt=Tt||lt,(K!==w||st!==_)&&(i.blendEquationSeparate(he[K],he[st]),w=K,_=st),(q!==S||lt!==x||ot!==A||Tt!==v)&&(i.blendFuncSeparate(qt[q],qt[lt],qt[ot],qt[Tt]),S=q,x=lt,A=ot,v=Tt),(Ht.equals(M)===!1||it!==N)&&(i.blendColor(Ht.r,Ht.g,Ht.b,it),M.copy(Ht),N=it),g=D,C=!1}function Ne(D,K){D.side===Oe?Ft(i.CULL_FACE):pt(i.CULL_FACE);let q=D.side===tn;K&&(q=!q),yn(q),D.blending===js&&D.transparent===!1?Je(Qn):Je(D.blending,D.blendEquation,D.blendSrc,D.blendDst,D.blendEquationAlpha,D.blendSrcAlpha,D.blendDstAlpha,D.blendColor,D.blendAlpha,D.premultipliedAlpha),o.setFunc(D.depthFunc),o.setTest(D.depthTest),o.setMask(D.depthWrite),r.setMask(D.colorWrite);let lt=D.stencilWrite;a.setTest(lt),lt&&(a.setMask(D.stencilWriteMask),a.setFunc(D.stencilFunc,D.stencilRef,D.stencilFuncMask),a.setOp(D.stencilFail,D.stencilZFail,D.stencilZPass)),Ve(D.polygonOffset,D.polygonOffsetFactor,D.polygonOffsetUnits),D.alphaToCoverage===!0?pt(i.SAMPLE_ALPHA_TO_COVERAGE):Ft(i.SAMPLE_ALPHA_TO_COVERAGE)}function yn(D){L!==D&&(D?i.frontFace(i.CW):i.frontFace(i.CCW),L=D)}function we(D){D!==rp?(pt(i.CULL_FACE),D!==I&&(D===qh?i.cullFace(i.BACK):D===op?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Ft(i.CULL_FACE),I=D}function ni(D){D!==F&&(W&&i.lineWidth(D),F=D)}function Ve(D,K,q){D?(pt(i.POLYGON_OFFSET_FILL),(k!==K||B!==q)&&(k=K,B=q,o.getReversed()&&(K=-K,q=-q),i.polygonOffset(K,q))):Ft(i.POLYGON_OFFSET_FILL)}function On(D){D?pt(i.SCISSOR_TEST):Ft(i.SCISSOR_TEST)}function Fn(D){D===void 0&&(D=i.TEXTURE0+G-1),Q!==D&&(i.activeTexture(D),Q=D)}function Un(D,K,q){q===void 0&&(Q===null?q=i.TEXTURE0+G-1:q=Q);let lt=tt[q];lt===void 0&&(lt={type:void 0,texture:void 0},tt[q]=lt),(lt.type!==D||lt.texture!==K)&&(Q!==q&&(i.activeTexture(q),Q=q),i.bindTexture(D,K||Ct[D]),lt.type=D,lt.texture=K)}function U(){let D=tt[Q];D!==void 0&&D.type!==void 0&&(i.bindTexture(D.type,null),D.type=void 0,D.texture=void 0)}function Bn(){try{i.compressedTexImage2D(...arguments)}catch(D){kt("WebGLState:",D)}}function ve(){try{i.compressedTexImage3D(...arguments)}catch(D){kt("WebGLState:",D)}}function ye(){try{i.texSubImage2D(...arguments)}catch(D){kt("WebGLState:",D)}}function ft(){try{i.texSubImage3D(...arguments)}catch(D){kt("WebGLState:",D)}}function De(){try{i.compressedTexSubImage2D(...arguments)}catch(D){kt("WebGLState:",D)}}function Rt(){try{i.compressedTexSubImage3D(...arguments)}catch(D){kt("WebGLState:",D)}}function Ut(){try{i.texStorage2D(...arguments)}catch(D){kt("WebGLState:",D)}}function R(){try{i.texStorage3D(...arguments)}catch(D){kt("WebGLState:",D)}}function T(){try{i.texImage2D(...arguments)}catch(D){kt("WebGLState:",D)}}function V(){try{i.texImage3D(...arguments)}catch(D){kt("WebGLState:",D)}}function nt(D){return u[D]!==void 0?u[D]:i.getParameter(D)}function j(D,K){u[D]!==K&&(i.pixelStorei(D,K),u[D]=K)}function rt(D){J.equals(D)===!1&&(i.scissor(D.x,D.y,D.z,D.w),J.copy(D))}function ut(D){ht.equals(D)===!1&&(i.viewport(D.x,D.y,D.z,D.w),ht.copy(D))}function Y(D,K){let q=c.get(K);q===void 0&&(q=new WeakMap,c.set(K,q));let lt=q.get(D);lt===void 0&&(lt=i.getUniformBlockIndex(K,D.name),i.uniformBlockBinding(K,lt,lt),q.set(D,lt))}function Z(D,K,q){let st=c.get(K).get(D);l[st]!==q&&(i.bindBufferBase(i.UNIFORM_BUFFER,st,q),l[st]=q)}function at(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,tt={},d={},l={},f=new WeakMap,p=[],b=null,m=!1,g=null,w=null,S=null,x=null,_=null,A=null,v=null,M=new Ot(0,0,0),N=0,C=!1,L=null,I=null,F=null,k=null,B=null,J.set(0,0,i.canvas.width,i.canvas.height),ht.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:pt,disable:Ft,bindFramebuffer:Te,drawBuffers:Pt,useProgram:jt,setBlending:Je,setMaterial:Ne,setFlipSided:yn,setCullFace:we,setLineWidth:ni,setPolygonOffset:Ve,setScissorTest:On,activeTexture:Fn,bindTexture:Un,unbindTexture:U,compressedTexImage2D:Bn,compressedTexImage3D:ve,texImage2D:T,texImage3D:V,pixelStorei:j,getParameter:nt,updateUBOMapping:Y,uniformBlockBinding:Z,texStorage2D:Ut,texStorage3D:R,texSubImage2D:ye,texSubImage3D:ft,compressedTexSubImage2D:De,compressedTexSubImage3D:Rt,scissor:rt,viewport:ut,reset:at}}function OS(i,t,e,n,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Et,h=new WeakMap,u=new Set,d,f=new WeakMap,p=new Set,b=new FinalizationRegistry(R=>p.delete(R)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(R,T){return m?new OffscreenCanvas(R,T):Br("canvas")}function w(R,T,V){let nt=1,j=Ut(R);if((j.width>V||j.height>V)&&(nt=V/Math.max(j.width,j.height)),nt<1)if(typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&R instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&R instanceof ImageBitmap||typeof VideoFrame<"u"&&R instanceof VideoFrame){let rt=Math.floor(nt*j.width),ut=Math.floor(nt*j.height);d===void 0&&(d=g(rt,ut));let Y=T?g(rt,ut):d;return Y.width=rt,Y.height=ut,Y.getContext("2d").drawImage(R,0,0,rt,ut),It("WebGLRenderer: Texture has been resized from ("+j.width+"x"+j.height+") to ("+rt+"x"+ut+")."),Y}else return"data"in R&&It("WebGLRenderer: Image in DataTexture is too big ("+j.width+"x"+j.height+")."),R;return R}function S(R){return R.generateMipmaps}function x(R){i.generateMipmap(R)}function _(R){return R.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:R.isWebGL3DRenderTarget?i.TEXTURE_3D:R.isWebGLArrayRenderTarget||R.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function A(R,T,V,nt,j,rt=!1){if(R!==null){if(i[R]!==void 0)return i[R];It("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+R+"'")}let ut;nt&&(ut=t.get("EXT_texture_norm16"),ut||It("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Y=T;if(T===i.RED&&(V===i.FLOAT&&(Y=i.R32F),V===i.HALF_FLOAT&&(Y=i.R16F),V===i.UNSIGNED_BYTE&&(Y=i.R8),V===i.UNSIGNED_SHORT&&ut&&(Y=ut.R16_EXT),V===i.SHORT&&ut&&(Y=ut.R16_SNORM_EXT)),T===i.RED_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.R8UI),V===i.UNSIGNED_SHORT&&(Y=i.R16UI),V===i.UNSIGNED_INT&&(Y=i.R32UI),V===i.BYTE&&(Y=i.R8I),V===i.SHORT&&(Y=i.R16I),V===i.INT&&(Y=i.R32I)),T===i.RG&&(V===i.FLOAT&&(Y=i.RG32F),V===i.HALF_FLOAT&&(Y=i.RG16F),V===i.UNSIGNED_BYTE&&(Y=i.RG8),V===i.UNSIGNED_SHORT&&ut&&(Y=ut.RG16_EXT),V===i.SHORT&&ut&&(Y=ut.RG16_SNORM_EXT)),T===i.RG_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.RG8UI),V===i.UNSIGNED_SHORT&&(Y=i.RG16UI),V===i.UNSIGNED_INT&&(Y=i.RG32UI),V===i.BYTE&&(Y=i.RG8I),V===i.SHORT&&(Y=i.RG16I),V===i.INT&&(Y=i.RG32I)),T===i.RGB_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.RGB8UI),V===i.UNSIGNED_SHORT&&(Y=i.RGB16UI),V===i.UNSIGNED_INT&&(Y=i.RGB32UI),V===i.BYTE&&(Y=i.RGB8I),V===i.SHORT&&(Y=i.RGB16I),V===i.INT&&(Y=i.RGB32I)),T===i.RGBA_INTEGER&&(V===i.UNSIGNED_BYTE&&(Y=i.RGBA8UI),V===i.UNSIGNED_SHORT&&(Y=i.RGBA16UI),V===i.UNSIGNED_INT&&(Y=i.RGBA32UI),V===i.BYTE&&(Y=i.RGBA8I),V===i.SHORT&&(Y=i.RGBA16I),V===i.INT&&(Y=i.RGBA32I)),T===i.RGB&&(V===i.UNSIGNED_SHORT&&ut&&(Y=ut.RGB16_EXT),V===i.SHORT&&ut&&(Y=ut.RGB16_SNORM_EXT),V===i.UNSIGNED_INT_5_9_9_9_REV&&(Y=i.RGB9_E5),V===i.UNSIGNED_INT_10F_11F_11F_REV&&(Y=i.R11F_G11F_B10F)),T===i.RGBA){let Z=rt?Fr:$t.getTransfer(j);V===i.FLOAT&&(Y=i.RGBA32F),V===i.HALF_FLOAT&&(Y=i.RGBA16F),V===i.UNSIGNED_BYTE&&(Y=Z===re?i.SRGB8_ALPHA8:i.RGBA8),V===i.UNSIGNED_SHORT&&ut&&(Y=ut.RGBA16_EXT),V===i.SHORT&&ut&&(Y=ut.RGBA16_SNORM_EXT),V===i.UNSIGNED_SHORT_4_4_4_4&&(Y=i.RGBA4),V===i.UNSIGNED_SHORT_5_5_5_1&&(Y=i.RGB5_A1)}return(Y===i.R16F||Y===i.R32F||Y===i.RG16F||Y===i.RG32F||Y===i.RGBA16F||Y===i.RGBA32F)&&t.get("EXT_color_buffer_float"),Y}function v(R,T){let V;return R?T===null||T===Mn||T===ms?V=i.DEPTH24_STENCIL8:T===Rn?V=i.DEPTH32F_STENCIL8:T===er&&(V=i.DEPTH24_STENCIL8,It("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):T===null||T===Mn||T===ms?V=i.DEPTH_COMPONENT24:T===Rn?V=i.DEPTH_COMPONENT32F:T===er&&(V=i.DEPTH_COMPONENT16),V}function M(R,T){return S(R)===!0||R.isFramebufferTexture&&R.minFilter!==Se&&R.minFilter!==Xe?Math.log2(Math.max(T.width,T.height))+1:R.mipmaps.length>0?R.mipmaps.length:R.isCompressedTexture&&Array.isArray(R.image)?T.mipmaps.length:1}function N(R){let T=new WeakRef(R);n.get(R).__ref=T,p.add(T),b.register(R,T,T)}function C(R){let T=n.get(R).__ref;T!==void 0&&(p.delete(T),b.unregister(T))}function L(R){F(R.target)}function I(R){k(R.target)}function F(R){R.removeEventListener("dispose",L),C(R),G(R),R.isVideoTexture&&h.delete(R),R.isHTMLTexture&&u.delete(R)}function k(R){R.removeEventListener("dispose",I),C(R),et(R)}function B(){for(let R of p){let T=R.deref();T!==void 0&&(T.isRenderTarget===!0?k(T):F(T))}p.clear(),u.clear()}function G(R){let T=n.get(R);if(T.__webglInit===void 0)return;let V=R.source,nt=f.get(V);if(nt){let j=nt[T.__cacheKey];j.usedTimes--,j.usedTimes===0&&W(R),Object.keys(nt).length===0&&f.delete(V)}n.remove(R)}function W(R){let T=n.get(R);i.deleteTexture(T.__webglTexture);let V=R.source,nt=f.get(V);delete nt[T.__cacheKey],o.memory.textures--}function et(R){let T=n.get(R);T.__depthDisposeCallback&&T.__depthDisposeCallback();let V=R.depthTexture;if(V&&V.renderTarget===R&&F(V),R.isWebGLCubeRenderTarget)for(let j=0;j<6;j++){if(Array.isArray(T.__webglFramebuffer[j]))for(let rt=0;rt<T.__webglFramebuffer[j].length;rt++)i.deleteFramebuffer(T.__webglFramebuffer[j][rt]);else i.deleteFramebuffer(T.__webglFramebuffer[j]);T.__webglDepthbuffer&&i.deleteRenderbuffer(T.__webglDepthbuffer[j])}else{if(Array.isArray(T.__webglFramebuffer))for(let j=0;j<T.__webglFramebuffer.length;j++)i.deleteFramebuffer(T.__webglFramebuffer[j]);else i.deleteFramebuffer(T.__webglFramebuffer);if(T.__webglDepthbuffer&&i.deleteRenderbuffer(T.__webglDepthbuffer),T.__webglMultisampledFramebuffer&&i.deleteFramebuffer(T.__webglMultisampledFramebuffer),T.__webglColorRenderbuffer)for(let j=0;j<T.__webglColorRenderbuffer.length;j++)T.__webglColorRenderbuffer[j]&&i.deleteRenderbuffer(T.__webglColorRenderbuffer[j]);T.__webglDepthRenderbuffer&&i.deleteRenderbuffer(T.__webglDepthRenderbuffer)}let nt=R.textures;for(let j=0,rt=nt.length;j<rt;j++){let ut=n.get(nt[j]);ut.__webglTexture&&(i.deleteTexture(ut.__webglTexture),o.memory.textures--),n.remove(nt[j])}n.remove(R)}let X=0;function Q(){X=0}function tt(){return X}function yt(R){X=R}function Nt(){let R=X;return R>=s.maxTextures&&It("WebGLTextures: Trying to use "+(R+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,R}function J(R){let T=[];return T.push(R.wrapS),T.push(R.wrapT),T.push(R.wrapR||0),T.push(R.magFilter),T.push(R.minFilter),T.push(R.anisotropy),T.push(R.internalFormat),T.push(R.format),T.push(R.type),T.push(R.generateMipmaps),T.push(R.mipmapsAutoUpdate),T.push(R.premultiplyAlpha),T.push(R.flipY),T.push(R.unpackAlignment),T.push(R.colorSpace),T.join()}function ht(R,T){let V=n.get(R);if(R.isVideoTexture&&De(R),R.isRenderTargetTexture===!1&&R.isExternalTexture!==!0&&R.version>0&&V.__version!==R.version){let nt=R.image;if(nt===null)It("WebGLRenderer: Texture marked for update but no image data found.");else if(nt.complete===!1)It("WebGLRenderer: Texture marked for update but image is incomplete");else{Ne(V,R,T);return}}else R.isExternalTexture&&(V.__webglTexture=R.sourceTexture?R.sourceTexture:null);e.bindTexture(i.TEXTURE_2D,V.__webglTexture,i.TEXTURE0+T)}function vt(R,T){let V=n.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&V.__version!==R.version){Ne(V,R,T);return}else R.isExternalTexture&&(V.__webglTexture=R.sourceTexture?R.sourceTexture:null);e.bindTexture(i.TEXTURE_2D_ARRAY,V.__webglTexture,i.TEXTURE0+T)}function Ct(R,T){let V=n.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&V.__version!==R.version){Ne(V,R,T);return}e.bindTexture(i.TEXTURE_3D,V.__webglTexture,i.TEXTURE0+T)}function pt(R,T){let V=n.get(R);if(R.version>0&&V.__version!==R.version){yn(V,R,T);return}e.bindTexture(i.TEXTURE_CUBE_MAP,V.__webglTexture,i.TEXTURE0+T)}let Ft={[Aa]:i.REPEAT,[oi]:i.CLAMP_TO_EDGE,[Ca]:i.MIRRORED_REPEAT},Te={[Se]:i.NEAREST,[Ep]:i.NEAREST_MIPMAP_NEAREST,[no]:i.NEAREST_MIPMAP_LINEAR,[Xe]:i.LINEAR,[Qa]:i.LINEAR_MIPMAP_NEAREST,[Ci]:i.LINEAR_MIPMAP_LINEAR},Pt={[Rp]:i.NEVER,[gu]:i.ALWAYS,[Lp]:i.LESS,[pu]:i.LEQUAL,[Ip]:i.EQUAL,[mu]:i.GEQUAL,[kp]:i.GREATER,[Np]:i.NOTEQUAL};function jt(R,T){if(T.type===Rn&&t.has("OES_texture_float_linear")===!1&&(T.magFilter===Xe||T.magFilter===Qa||T.magFilter===no||T.magFilter===Ci||T.minFilter===Xe||T.minFilter===Qa||T.minFilter===no||T.minFilter===Ci)&&It("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(R,i.TEXTURE_WRAP_S,Ft[T.wrapS]),i.texParameteri(R,i.TEXTURE_WRAP_T,Ft[T.wrapT]),(R===i.TEXTURE_3D||R===i.TEXTURE_2D_ARRAY)&&i.texParameteri(R,i.TEXTURE_WRAP_R,Ft[T.wrapR]),i.texParameteri(R,i.TEXTURE_MAG_FILTER,Te[T.magFilter]),i.texParameteri(R,i.TEXTURE_MIN_FILTER,Te[T.minFilter]),T.compareFunction&&(i.texParameteri(R,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(R,i.TEXTURE_COMPARE_FUNC,Pt[T.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(T.magFilter===Se||T.minFilter!==no&&T.minFilter!==Ci||T.type===Rn&&t.has("OES_texture_float_linear")===!1)return;if(T.anisotropy>1||n.get(T).__currentAnisotropy){let V=t.get("EXT_texture_filter_anisotropic");i.texParameterf(R,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(T.anisotropy,s.getMaxAnisotropy())),n.get(T).__currentAnisotropy=T.anisotropy}}}function he(R,T){let V=!1;R.__webglInit===void 0&&(R.__webglInit=!0,T.addEventListener("dispose",L),N(T));let nt=T.source,j=f.get(nt);j===void 0&&(j={},f.set(nt,j));let rt=J(T);if(rt!==R.__cacheKey){j[rt]===void 0&&(j[rt]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,V=!0),j[rt].usedTimes++;let ut=j[R.__cacheKey];ut!==void 0&&(j[R.__cacheKey].usedTimes--,ut.usedTimes===0&&W(T)),R.__cacheKey=rt,R.__webglTexture=j[rt].texture}return V}function qt(R,T,V){return Math.floor(Math.floor(R/V)/T)}function Je(R,T,V,nt){let rt=R.updateRanges;if(rt.length===0)e.texSubImage2D(i.TEXTURE_2D,0,0,0,T.width,T.height,V,nt,T.data);else{rt.sort((D,K)=>D.start-K.start);let ut=0;for(let D=1;D<rt.length;D++){let K=rt[ut],q=rt[D],lt=K.start+K.count,st=qt(q.start,T.width,4),ot=qt(K.start,T.width,4);q.start<=lt+1&&st===ot&&qt(q.start+q.count-1,T.width,4)===st?K.count=Math.max(K.count,q.start+q.count-K.start):(++ut,rt[ut]=q)}rt.length=ut+1;let Y=e.getParameter(i.UNPACK_ROW_LENGTH),Z=e.getParameter(i.UNPACK_SKIP_PIXELS),at=e.getParameter(i.UNPACK_SKIP_ROWS);e.pixelStorei(i.UNPACK_ROW_LENGTH,T.width);for(let D=0,K=rt.length;D<K;D++){let q=rt[D],lt=Math.floor(q.start/4),st=Math.ceil(q.count/4),ot=lt%T.width,Tt=Math.floor(lt/T.width),Ht=st,it=1;e.pixelStorei(i.UNPACK_SKIP_PIXELS,ot),e.pixelStorei(i.UNPACK_SKIP_ROWS,Tt),e.texSubImage2D(i.TEXTURE_2D,0,ot,Tt,Ht,it,V,nt,T.data)}R.clearUpdateRanges(),e.pixelStorei(i.UNPACK_ROW_LENGTH,Y),e.pixelStorei(i.UNPACK_SKIP_PIXELS,Z),e.pixelStorei(i.UNPACK_SKIP_ROWS,at)}}function Ne(R,T,V){let nt=i.TEXTURE_2D;(T.isDataArrayTexture||T.isCompressedArrayTexture)&&(nt=i.TEXTURE_2D_ARRAY),T.isData3DTexture&&(nt=i.TEXTURE_3D);let j=he(R,T),rt=T.source;e.bindTexture(nt,R.__webglTexture,i.TEXTURE0+V);let ut=n.get(rt);if(rt.version!==ut.__version||j===!0){if(e.activeTexture(i.TEXTURE0+V),(typeof ImageBitmap<"u"&&T.image instanceof ImageBitmap)===!1){let it=$t.getPrimaries($t.workingColorSpace),At=T.colorSpace===Ri?null:$t.getPrimaries(T.colorSpace),zt=T.colorSpace===Ri||it===At?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,T.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,zt)}e.pixelStorei(i.UNPACK_ALIGNMENT,T.unpackAlignment);let Z=w(T.image,!1,s.maxTextureSize);Z=Rt(T,Z);let at=r.convert(T.format,T.colorSpace),D=r.convert(T.type),K=A(T.internalFormat,at,D,T.normalized,T.colorSpace,T.isVideoTexture);jt(nt,T);let q,lt=T.mipmaps,st=T.isVideoTexture!==!0,ot=ut.__version===void 0||j===!0,Tt=rt.dataReady,Ht=M(T,Z);if(T.isDepthTexture)K=v(T.format===Pi,T.type),ot&&(st?e.texStorage2D(i.TEXTURE_2D,1,K,Z.width,Z.height):e.texImage2D(i.TEXTURE_2D,0,K,Z.width,Z.height,0,at,D,null));else if(T.isDataTexture)if(lt.length>0){st&&ot&&e.texStorage2D(i.TEXTURE_2D,Ht,K,lt[0].width,lt[0].height);for(let it=0,At=lt.length;it<At;it++)q=lt[it],st?Tt&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,q.width,q.height,at,D,q.data):e.texImage2D(i.TEXTURE_2D,it,K,q.width,q.height,0,at,D,q.data);T.generateMipmaps=!1}else st?(ot&&e.texStorage2D(i.TEXTURE_2D,Ht,K,Z.width,Z.height),Tt&&Je(T,Z,at,D)):e.texImage2D(i.TEXTURE_2D,0,K,Z.width,Z.height,0,at,D,Z.data);else if(T.isCompressedTexture)if(T.isCompressedArrayTexture){st&&ot&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Ht,K,lt[0].width,lt[0].height,Z.depth);for(let it=0,At=lt.length;it<At;it++)if(q=lt[it],T.format!==je)if(at!==null)if(st){if(Tt)if(T.layerUpdates.size>0){let zt=Su(q.width,q.height,T.format,T.type);for(let mt of T.layerUpdates){let ae=q.data.subarray(mt*zt/q.data.BYTES_PER_ELEMENT,(mt+1)*zt/q.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,mt,q.width,q.height,1,at,ae)}}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,0,q.width,q.height,Z.depth,at,q.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,it,K,q.width,q.height,Z.depth,0,q.data,0,0);else It("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else st?Tt&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,0,q.width,q.height,Z.depth,at,D,q.data):e.texImage3D(i.TEXTURE_2D_ARRAY,it,K,q.width,q.height,Z.depth,0,at,D,q.data);T.layerUpdates.size>0&&T.clearLayerUpdates()}else{st&&ot&&e.texStorage2D(i.TEXTURE_2D,Ht,K,lt[0].width,lt[0].height);for(let it=0,At=lt.length;it<At;it++)q=lt[it],T.format!==je?at!==null?st?Tt&&e.compressedTexSubImage2D(i.TEXTURE_2D,it,0,0,q.width,q.height,at,q.data):e.compressedTexImage2D(i.TEXTURE_2D,it,K,q.width,q.height,0,q.data):It("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):st?Tt&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,q.width,q.height,at,D,q.data):e.texImage2D(i.TEXTURE_2D,it,K,q.width,q.height,0,at,D,q.data)}else if(T.isDataArrayTexture)if(st){if(ot&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Ht,K,Z.width,Z.height,Z.depth),Tt)if(T.layerUpdates.size>0){let it=Su(Z.width,Z.height,T.format,T.type);for(let At of T.layerUpdates){let zt=Z.data.subarray(At*it/Z.data.BYTES_PER_ELEMENT,(At+1)*it/Z.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,At,Z.width,Z.height,1,at,D,zt)}T.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,Z.width,Z.height,Z.depth,at,D,Z.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,K,Z.width,Z.height,Z.depth,0,at,D,Z.data);else if(T.isData3DTexture)st?(ot&&e.texStorage3D(i.TEXTURE_3D,Ht,K,Z.width,Z.height,Z.depth),Tt&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,Z.width,Z.height,Z.depth,at,D,Z.data)):e.texImage3D(i.TEXTURE_3D,0,K,Z.width,Z.height,Z.depth,0,at,D,Z.data);else if(T.isFramebufferTexture){if(ot)if(st)e.texStorage2D(i.TEXTURE_2D,Ht,K,Z.width,Z.height);else{let it=Z.width,At=Z.height;for(let zt=0;zt<Ht;zt++)e.texImage2D(i.TEXTURE_2D,zt,K,it,At,0,at,D,null),it>>=1,At>>=1}}else if(T.isHTMLTexture){if("texElementImage2D"in i){let it=i.canvas;if(it.hasAttribute("layoutsubtree")||it.setAttribute("layoutsubtree","true"),Z.parentNode!==it){it.appendChild(Z),u.add(T),it.onpaint=At=>{let zt=At.changedElements;for(let mt of u)zt.includes(mt.image)&&(mt.needsUpdate=!0)},it.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,Z);else{let zt=i.RGBA,mt=i.RGBA,ae=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,zt,mt,ae,Z)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(lt.length>0){if(st&&ot){let it=Ut(lt[0]);e.texStorage2D(i.TEXTURE_2D,Ht,K,it.width,it.height)}for(let it=0,At=lt.length;it<At;it++)q=lt[it],st?Tt&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,at,D,q):e.texImage2D(i.TEXTURE_2D,it,K,at,D,q);T.generateMipmaps=!1}else if(st){if(ot){let it=Ut(Z);e.texStorage2D(i.TEXTURE_2D,Ht,K,it.width,it.height)}Tt&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,at,D,Z)}else e.texImage2D(i.TEXTURE_2D,0,K,at,D,Z);S(T)&&T.mipmapsAutoUpdate===!0&&x(nt),ut.__version=rt.version,T.onUpdate&&T.onUpdate(T)}R.__version=T.version}function yn(R,T,V){if(T.image.length!==6)return;let nt=he(R,T),j=T.source;e.bindTexture(i.TEXTURE_CUBE_MAP,R.__webglTexture,i.TEXTURE0+V);let rt=n.get(j);if(j.version!==rt.__version||nt===!0){e.activeTexture(i.TEXTURE0+V);let ut=$t.getPrimaries($t.workingColorSpace),Y=T.colorSpace===Ri?null:$t.getPrimaries(T.colorSpace),Z=T.colorSpace===Ri||ut===Y?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,T.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),e.pixelStorei(i.UNPACK_ALIGNMENT,T.unpackAlignment),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Z);let at=T.isCompressedTexture||T.image[0].isCompressedTexture,D=T.image[0]&&T.image[0].isDataTexture,K=[];for(let mt=0;mt<6;mt++)!at&&!D?K[mt]=w(T.image[mt],!0,s.maxCubemapSize):K[mt]=D?T.image[mt].image:T.image[mt],K[mt]=Rt(T,K[mt]);let q=K[0],lt=r.convert(T.format,T.colorSpace),st=r.convert(T.type),ot=A(T.internalFormat,lt,st,T.normalized,T.colorSpace),Tt=T.isVideoTexture!==!0,Ht=rt.__version===void 0||nt===!0,it=j.dataReady,At=M(T,q);jt(i.TEXTURE_CUBE_MAP,T);let zt;if(T.isDepthTexture){if(ot=v(T.format===Pi,T.type),Ht)if(Tt)e.texStorage2D(i.TEXTURE_CUBE_MAP,1,ot,q.width,q.height);else for(let mt=0;mt<6;mt++)e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,ot,q.width,q.height,0,lt,st,null)}else if(at){Tt&&Ht&&e.texStorage2D(i.TEXTURE_CUBE_MAP,At,ot,q.width,q.height);for(let mt=0;mt<6;mt++){zt=K[mt].mipmaps;for(let ae=0;ae<zt.length;ae++){let He=zt[ae];T.format!==je?lt!==null?Tt?it&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae,0,0,He.width,He.height,lt,He.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae,ot,He.width,He.height,0,He.data):It("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Tt?it&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae,0,0,He.width,He.height,lt,st,He.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae,ot,He.width,He.height,0,lt,st,He.data)}}}else{if(zt=T.mipmaps,Tt&&Ht){zt.length>0&&At++;let mt=Ut(K[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,At,ot,mt.width,mt.height)}for(let mt=0;mt<6;mt++)if(D){Tt?it&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,0,0,K[mt].width,K[mt].height,lt,st,K[mt].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,ot,K[mt].width,K[mt].height,0,lt,st,K[mt].data);for(let ae=0;ae<zt.length;ae++){let Ni=zt[ae].image[mt].image;Tt?it&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae+1,0,0,Ni.width,Ni.height,lt,st,Ni.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae+1,ot,Ni.width,Ni.height,0,lt,st,Ni.data)}}else{Tt?it&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,0,0,lt,st,K[mt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,0,ot,lt,st,K[mt]);for(let ae=0;ae<zt.length;ae++){let He=zt[ae];Tt?it&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae+1,0,0,lt,st,He.image[mt]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+mt,ae+1,ot,lt,st,He.image[mt])}}}S(T)&&T.mipmapsAutoUpdate===!0&&x(i.TEXTURE_CUBE_MAP),rt.__version=j.version,T.onUpdate&&T.onUpdate(T)}R.__version=T.version}function we(R,T,V,nt,j,rt){let ut=r.convert(V.format,V.colorSpace),Y=r.convert(V.type),Z=A(V.internalFormat,ut,Y,V.normalized,V.colorSpace),at=n.get(T),D=n.get(V);if(D.__renderTarget=T,!at.__hasExternalTextures){let K=Math.max(1,T.width>>rt),q=Math.max(1,T.height>>rt);j===i.TEXTURE_3D||j===i.TEXTURE_2D_ARRAY?e.texImage3D(j,rt,Z,K,q,T.depth,0,ut,Y,null):e.texImage2D(j,rt,Z,K,q,0,ut,Y,null)}e.bindFramebuffer(i.FRAMEBUFFER,R),ft(T)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,nt,j,D.__webglTexture,0,ye(T)):(j===i.TEXTURE_2D||j>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&j<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,nt,j,D.__webglTexture,rt),e.bindFramebuffer(i.FRAMEBUFFER,null)}function ni(R,T,V){if(i.bindRenderbuffer(i.RENDERBUFFER,R),T.depthBuffer){let nt=T.depthTexture,j=nt&&nt.isDepthTexture?nt.type:null,rt=v(T.stencilBuffer,j),ut=T.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;ft(T)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ye(T),rt,T.width,T.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,ye(T),rt,T.width,T.height):i.renderbufferStorage(i.RENDERBUFFER,rt,T.width,T.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,ut,i.RENDERBUFFER,R)}else{let nt=T.textures;for(let j=0;j<nt.length;j++){let rt=nt[j],ut=r.convert(rt.format,rt.colorSpace),Y=r.convert(rt.type),Z=A(rt.internalFormat,ut,Y,rt.normalized,rt.colorSpace);ft(T)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ye(T),Z,T.width,T.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,ye(T),Z,T.width,T.height):i.renderbufferStorage(i.RENDERBUFFER,Z,T.width,T.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Ve(R,T,V){let nt=T.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(i.FRAMEBUFFER,R),!(T.depthTexture&&T.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let j=n.get(T.depthTexture);j.__renderTarget=T;let rt=nt?T.depthTexture.image[0]:T.depthTexture.image;(!j.__webglTexture||rt.width!==T.width||rt.height!==T.height)&&(rt.width=T.width,rt.height=T.height,T.depthTexture.needsUpdate=!0),nt?pt(T.depthTexture,0):ht(T.depthTexture,0);let ut=j.__webglTexture,Y=ye(T),Z=nt?i.TEXTURE_CUBE_MAP_POSITIVE_X+V:i.TEXTURE_2D,at=T.depthTexture.format===Pi?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(T.depthTexture.format===Ei)ft(T)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,at,Z,ut,0,Y):i.framebufferTexture2D(i.FRAMEBUFFER,at,Z,ut,0);else if(T.depthTexture.format===Pi)ft(T)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,at,Z,ut,0,Y):i.framebufferTexture2D(i.FRAMEBUFFER,at,Z,ut,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function On(R){let T=n.get(R),V=R.isWebGLCubeRenderTarget===!0;if(T.__boundDepthTexture!==R.depthTexture){let nt=R.depthTexture;if(T.__depthDisposeCallback&&T.__depthDisposeCallback(),nt){let j=()=>{delete T.__boundDepthTexture,delete T.__depthDisposeCallback,nt.removeEventListener("dispose",j)};nt.addEventListener("dispose",j),T.__depthDisposeCallback=j}T.__boundDepthTexture=nt}if(R.depthTexture&&!T.__autoAllocateDepthBuffer)if(V)for(let nt=0;nt<6;nt++)Ve(T.__webglFramebuffer[nt],R,nt);else R.texture.mipmaps.length>0?Ve(T.__webglFramebuffer[0],R,0):Ve(T.__webglFramebuffer,R,0);else if(V){T.__webglDepthbuffer=[];for(let nt=0;nt<6;nt++)if(e.bindFramebuffer(i.FRAMEBUFFER,T.__webglFramebuffer[nt]),T.__webglDepthbuffer[nt]===void 0)T.__webglDepthbuffer[nt]=i.createRenderbuffer(),ni(T.__webglDepthbuffer[nt],R,!1);else{let j=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,rt=T.__webglDepthbuffer[nt];i.bindRenderbuffer(i.RENDERBUFFER,rt),i.framebufferRenderbuffer(i.FRAMEBUFFER,j,i.RENDERBUFFER,rt)}}else if(R.texture.mipmaps.length>0?e.bindFramebuffer(i.FRAMEBUFFER,T.__webglFramebuffer[0]):e.bindFramebuffer(i.FRAMEBUFFER,T.__webglFramebuffer),T.__webglDepthbuffer===void 0)T.__webglDepthbuffer=i.createRenderbuffer(),ni(T.__webglDepthbuffer,R,!1);else{let j=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,rt=T.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,rt),i.framebufferRenderbuffer(i.FRAMEBUFFER,j,i.RENDERBUFFER,rt)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function Fn(R,T,V){let nt=n.get(R);T!==void 0&&we(nt.__webglFramebuffer,R,R.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),V!==void 0&&On(R)}function Un(R){let T=R.texture,V=n.get(R),nt=n.get(T);R.addEventListener("dispose",I),N(R);let j=R.textures,rt=R.isWebGLCubeRenderTarget===!0,ut=j.length>1;if(ut||(nt.__webglTexture===void 0&&(nt.__webglTexture=i.createTexture()),nt.__version=T.version,o.memory.textures++),rt){V.__webglFramebuffer=[];for(let Y=0;Y<6;Y++)if(T.mipmaps.length>0){V.__webglFramebuffer[Y]=[];for(let Z=0;Z<T.mipmaps.length;Z++)V.__webglFramebuffer[Y][Z]=i.createFramebuffer()}else V.__webglFramebuffer[Y]=i.createFramebuffer()}else{if(T.mipmaps.length>0){V.__webglFramebuffer=[];for(let Y=0;Y<T.mipmaps.length;Y++)V.__webglFramebuffer[Y]=i.createFramebuffer()}else V.__webglFramebuffer=i.createFramebuffer();if(ut)for(let Y=0,Z=j.length;Y<Z;Y++){let at=n.get(j[Y]);at.__webglTexture===void 0&&(at.__webglTexture=i.createTexture(),o.memory.textures++)}if(R.samples>0&&ft(R)===!1){V.__webglMultisampledFramebuffer=i.createFramebuffer(),V.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let Y=0;Y<j.length;Y++){let Z=j[Y];V.__webglColorRenderbuffer[Y]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,V.__webglColorRenderbuffer[Y]);let at=r.convert(Z.format,Z.colorSpace),D=r.convert(Z.type),K=A(Z.internalFormat,at,D,Z.normalized,Z.colorSpace,R.isXRRenderTarget===!0),q=ye(R);i.renderbufferStorageMultisample(i.RENDERBUFFER,q,K,R.width,R.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Y,i.RENDERBUFFER,V.__webglColorRenderbuffer[Y])}i.bindRenderbuffer(i.RENDERBUFFER,null),R.depthBuffer&&(V.__webglDepthRenderbuffer=i.createRenderbuffer(),ni(V.__webglDepthRenderbuffer,R,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(rt){e.bindTexture(i.TEXTURE_CUBE_MAP,nt.__webglTexture),jt(i.TEXTURE_CUBE_MAP,T);for(let Y=0;Y<6;Y++)if(T.mipmaps.length>0)for(let Z=0;Z<T.mipmaps.length;Z++)we(V.__webglFramebuffer[Y][Z],R,T,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+Y,Z);else we(V.__webglFramebuffer[Y],R,T,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+Y,0);S(T)?x(i.TEXTURE_CUBE_MAP):T.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),e.unbindTexture()}else if(ut){for(let Y=0,Z=j.length;Y<Z;Y++){let at=j[Y],D=n.get(at),K=i.TEXTURE_2D;(R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(K=R.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(K,D.__webglTexture),jt(K,at),we(V.__webglFramebuffer,R,at,i.COLOR_ATTACHMENT0+Y,K,0),S(at)&&x(K)}e.unbindTexture()}else{let Y=i.TEXTURE_2D;if((R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(Y=R.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(Y,nt.__webglTexture),jt(Y,T),T.mipmaps.length>0)for(let Z=0;Z<T.mipmaps.length;Z++)we(V.__webglFramebuffer[Z],R,T,i.COLOR_ATTACHMENT0,Y,Z);else we(V.__webglFramebuffer,R,T,i.COLOR_ATTACHMENT0,Y,0);S(T)?x(Y):T.mipmaps.length>0&&i.texParameteri(Y,i.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),e.unbindTexture()}R.depthBuffer&&On(R)}function U(R){let T=R.textures;for(let V=0,nt=T.length;V<nt;V++){let j=T[V];if(S(j)&&j.mipmapsAutoUpdate===!0){let rt=_(R),ut=n.get(j).__webglTexture;e.bindTexture(rt,ut),x(rt),e.unbindTexture()}}}let Bn=[];function ve(R){if(R.samples>0){if(ft(R)===!1){let T=R.textures,V=R.width,nt=R.height,j=i.COLOR_BUFFER_BIT,rt=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ut=n.get(R),Y=T.length>1;if(Y)for(let at=0;at<T.length;at++)e.bindFramebuffer(i.FRAMEBUFFER,ut.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+at,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,ut.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+at,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,ut.__webglMultisampledFramebuffer),R.texture.mipmaps.length>0?e.bindFramebuffer(i.DRAW_FRAMEBUFFER,ut.__webglFramebuffer[0]):e.bindFramebuffer(i.DRAW_FRAMEBUFFER,ut.__webglFramebuffer);for(let at=0;at<T.length;at++){if(R.resolveDepthBuffer&&(R.depthBuffer&&(j|=i.DEPTH_BUFFER_BIT),R.stencilBuffer&&R.resolveStencilBuffer&&(j|=i.STENCIL_BUFFER_BIT)),Y){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,ut.__webglColorRenderbuffer[at]);let D=n.get(T[at]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,D,0)}i.blitFramebuffer(0,0,V,nt,0,0,V,nt,j,i.NEAREST),l===!0&&(Bn.length=0,Bn.push(i.COLOR_ATTACHMENT0+at),R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&Bn.push(rt),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Bn))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),Y)for(let at=0;at<T.length;at++){e.bindFramebuffer(i.FRAMEBUFFER,ut.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+at,i.RENDERBUFFER,ut.__webglColorRenderbuffer[at]);let D=n.get(T[at]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,ut.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+at,i.TEXTURE_2D,D,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,ut.__webglMultisampledFramebuffer)}else if(R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&l){let T=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[T])}}}function ye(R){return Math.min(s.maxSamples,R.samples)}function ft(R){let T=n.get(R);return R.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&T.__useRenderToTexture!==!1}function De(R){let T=o.render.frame;h.get(R)!==T&&(h.set(R,T),R.update())}function Rt(R,T){let V=R.colorSpace,nt=R.format,j=R.type;return R.isCompressedTexture===!0||R.isVideoTexture===!0||V!==Or&&V!==Ri&&($t.getTransfer(V)===re?(nt!==je||j!==en)&&It("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):kt("WebGLTextures: Unsupported texture color space:",V)),T}function Ut(R){return typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement?(c.width=R.naturalWidth||R.width,c.height=R.naturalHeight||R.height):typeof VideoFrame<"u"&&R instanceof VideoFrame?(c.width=R.displayWidth,c.height=R.displayHeight):(c.width=R.width,c.height=R.height),c}this.allocateTextureUnit=Nt,this.resetTextureUnits=Q,this.getTextureUnits=tt,this.setTextureUnits=yt,this.setTexture2D=ht,this.setTexture2DArray=vt,this.setTexture3D=Ct,this.setTextureCube=pt,this.rebindTextures=Fn,this.setupRenderTarget=Un,this.updateRenderTargetMipmap=U,this.updateMultisampleRenderTarget=ve,this.setupDepthRenderbuffer=On,this.setupFrameBufferTexture=we,this.useMultisampledRTT=ft,this.dispose=B}function FS(i,t){function e(n,s=Ri){let r,o=$t.getTransfer(s);if(n===en)return i.UNSIGNED_BYTE;if(n===el)return i.UNSIGNED_SHORT_4_4_4_4;if(n===nl)return i.UNSIGNED_SHORT_5_5_5_1;if(n===lu)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===cu)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===ou)return i.BYTE;if(n===au)return i.SHORT;if(n===er)return i.UNSIGNED_SHORT;if(n===tl)return i.INT;if(n===Mn)return i.UNSIGNED_INT;if(n===Rn)return i.FLOAT;if(n===kn)return i.HALF_FLOAT;if(n===hu)return i.ALPHA;if(n===uu)return i.RGB;if(n===je)return i.RGBA;if(n===Ei)return i.DEPTH_COMPONENT;if(n===Pi)return i.DEPTH_STENCIL;if(n===du)return i.RED;if(n===io)return i.RED_INTEGER;if(n===Yi)return i.RG;if(n===il)return i.RG_INTEGER;if(n===sl)return i.RGBA_INTEGER;if(n===so||n===ro||n===oo||n===ao)if(o===re)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===so)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===ro)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===oo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===ao)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===so)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===ro)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===oo)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===ao)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===rl||n===ol||n===al||n===ll)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===rl)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===ol)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===al)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===ll)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===cl||n===hl||n===ul||n===dl||n===fl||n===lo||n===pl)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===cl||n===hl)return o===re?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===ul)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===dl)return r.COMPRESSED_R11_EAC;if(n===fl)return r.COMPRESSED_SIGNED_R11_EAC;if(n===lo)return r.COMPRESSED_RG11_EAC;if(n===pl)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===ml||n===gl||n===xl||n===vl||n===yl||n===bl||n===wl||n===_l||n===Sl||n===Ml||n===Tl||n===El||n===Al||n===Cl)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===ml)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===gl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===xl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===vl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===yl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===bl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===wl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===_l)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Sl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Ml)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Tl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===El)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Al)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===Cl)return o===re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Pl||n===Rl||n===Ll)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===Pl)return o===re?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Rl)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Ll)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Il||n===kl||n===co||n===Nl)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Il)return r.COMPRESSED_RED_RGTC1_EXT;if(n===kl)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===co)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Nl)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===ms?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}var US=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,BS=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Iu=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let n=new Zr(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=n}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new hn({vertexShader:US,fragmentShader:BS,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new Ie(new Ai(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},ku=class extends li{constructor(t,e){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,p=null,b=typeof XRWebGLBinding<"u",m=new Iu,g={},w=e.getContextAttributes(),S=null,x=null,_=[],A=[],v=new Et,M=null,N=null,C=new mn;C.viewport=new Wt;let L=new mn;L.viewport=new Wt;let I=[C,L],F=new Za,k=null,B=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(J){let ht=_[J];return ht===void 0&&(ht=new qs,_[J]=ht),ht.getTargetRaySpace()},this.getControllerGrip=function(J){let ht=_[J];return ht===void 0&&(ht=new qs,_[J]=ht),ht.getGripSpace()},this.getHand=function(J){let ht=_[J];return ht===void 0&&(ht=new qs,_[J]=ht),ht.getHandSpace()};function G(J){let ht=A.indexOf(J.inputSource);if(ht===-1)return;let vt=_[ht];vt!==void 0&&(vt.update(J.inputSource,J.frame,c||o),vt.dispatchEvent({type:J.type,data:J.inputSource}))}function W(){s.removeEventListener("select",G),s.removeEventListener("selectstart",G),s.removeEventListener("selectend",G),s.removeEventListener("squeeze",G),s.removeEventListener("squeezestart",G),s.removeEventListener("squeezeend",G),s.removeEventListener("end",W),s.removeEventListener("inputsourceschange",et);for(let J=0;J<_.length;J++){let ht=A[J];ht!==null&&(A[J]=null,_[J].disconnect(ht))}k=null,B=null,m.reset();for(let J in g)delete g[J];if(t.setRenderTarget(S),f=null,d=null,u=null,s=null,x=null,Nt.stop(),n.isPresenting=!1,t.setPixelRatio(M),t.setSize(v.width,v.height,!1),N!==null){let J=N.camera;J.fov=N.fov,J.zoom=N.zoom,J.updateProjectionMatrix(),N=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(J){r=J,n.isPresenting===!0&&It("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(J){a=J,n.isPresenting===!0&&It("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(J){c=J},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&b&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(J){if(s=J,s!==null){if(S=t.getRenderTarget(),s.addEventListener("select",G),s.addEventListener("selectstart",G),s.addEventListener("selectend",G),s.addEventListener("squeeze",G),s.addEventListener("squeezestart",G),s.addEventListener("squeezeend",G),s.addEventListener("end",W),s.addEventListener("inputsourceschange",et),w.xrCompatible!==!0&&await e.makeXRCompatible(),M=t.getPixelRatio(),t.getSize(v),b&&"createProjectionLayer"in XRWebGLBinding.prototype){let vt=null,Ct=null,pt=null;w.depth&&(pt=w.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,vt=w.stencil?Pi:Ei,Ct=w.stencil?ms:Mn);let Ft={colorFormat:e.RGBA8,depthFormat:pt,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Ft),s.updateRenderState({layers:[d]}),t.setPixelRatio(1),t.setSize(d.textureWidth,d.textureHeight,!1),x=new Re(d.textureWidth,d.textureHeight,{format:je,type:en,depthTexture:new Jn(d.textureWidth,d.textureHeight,Ct,void 0,void 0,void 0,void 0,void 0,void 0,vt),stencilBuffer:w.stencil,colorSpace:t.outputColorSpace,samples:w.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let vt={antialias:w.antialias,alpha:!0,depth:w.depth,stencil:w.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,e,vt),s.updateRenderState({baseLayer:f}),t.setPixelRatio(1),t.setSize(f.framebufferWidth,f.framebufferHeight,!1),x=new Re(f.framebufferWidth,f.framebufferHeight,{format:je,type:en,colorSpace:t.outputColorSpace,stencilBuffer:w.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}x.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),Nt.setContext(s),Nt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function et(J){for(let ht=0;ht<J.removed.length;ht++){let vt=J.removed[ht],Ct=A.indexOf(vt);Ct>=0&&(A[Ct]=null,_[Ct].disconnect(vt))}for(let ht=0;ht<J.added.length;ht++){let vt=J.added[ht],Ct=A.indexOf(vt);if(Ct===-1){for(let Ft=0;Ft<_.length;Ft++)if(Ft>=A.length){A.push(vt),Ct=Ft;break}else if(A[Ft]===null){A[Ft]=vt,Ct=Ft;break}if(Ct===-1)break}let pt=_[Ct];pt&&pt.connect(vt)}}function X(J,ht){ht===null?J.matrixWorld.copy(J.matrix):J.matrixWorld.multiplyMatrices(ht.matrixWorld,J.matrix),J.matrixWorldInverse.copy(J.matrixWorld).invert()}this.updateCamera=function(J){if(s===null)return;let ht=J.near,vt=J.far;m.texture!==null&&(m.depthNear>0&&(ht=m.depthNear),m.depthFar>0&&(vt=m.depthFar)),F.near=L.near=C.near=ht,F.far=L.far=C.far=vt,(k!==F.near||B!==F.far)&&(s.updateRenderState({depthNear:F.near,depthFar:F.far}),k=F.near,B=F.far),F.layers.mask=J.layers.mask|6,C.layers.mask=F.layers.mask&-5,L.layers.mask=F.layers.mask&-3;let Ct=J.parent,pt=F.cameras;X(F,Ct);for(let Ft=0;Ft<pt.length;Ft++)X(pt[Ft],Ct);F.projectionMatrix.copy(C.projectionMatrix),F.projectionMatrixInverse.copy(C.projectionMatrixInverse),N===null&&J.isPerspectiveCamera&&(N={camera:J,fov:J.fov,zoom:J.zoom}),Q(J,F,Ct)};function Q(J,ht,vt){vt===null?J.matrix.copy(ht.matrixWorld):(J.matrix.copy(vt.matrixWorld),J.matrix.invert(),J.matrix.multiply(ht.matrixWorld)),J.matrix.decompose(J.position,J.quaternion,J.scale),J.updateMatrixWorld(!0),J.projectionMatrix.copy(ht.projectionMatrix),J.projectionMatrixInverse.copy(ht.projectionMatrixInverse),J.isPerspectiveCamera&&(J.fov=Ra*2*Math.atan(1/J.projectionMatrix.elements[5]),J.zoom=1)}this.getCamera=function(){return F},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(J){l=J,d!==null&&(d.fixedFoveation=J),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=J)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(F)},this.getCameraTexture=function(J){return g[J]};let tt=null;function yt(J,ht){if(h=ht.getViewerPose(c||o),p=ht,h!==null){let vt=h.views;f!==null&&(t.setRenderTargetFramebuffer(x,f.framebuffer),t.setRenderTarget(x));let Ct=!1;vt.length!==F.cameras.length&&(F.cameras.length=0,Ct=!0);for(let Pt=0;Pt<vt.length;Pt++){let jt=vt[Pt],he=null;if(f!==null)he=f.getViewport(jt);else{let Je=u.getViewSubImage(d,jt);he=Je.viewport,Pt===0&&(t.setRenderTargetTextures(x,Je.colorTexture,Je.depthStencilTexture),t.setRenderTarget(x))}let qt=I[Pt];qt===void 0&&(qt=new mn,qt.layers.enable(Pt),qt.viewport=new Wt,I[Pt]=qt),qt.matrix.fromArray(jt.transform.matrix),qt.matrix.decompose(qt.position,qt.quaternion,qt.scale),qt.projectionMatrix.fromArray(jt.projectionMatrix),qt.projectionMatrixInverse.copy(qt.projectionMatrix).invert(),qt.viewport.set(he.x,he.y,he.width,he.height),Pt===0&&(F.matrix.copy(qt.matrix),F.matrix.decompose(F.position,F.quaternion,F.scale)),Ct===!0&&F.cameras.push(qt)}let pt=s.enabledFeatures;if(pt&&pt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&b){u=n.getBinding();let Pt=u.getDepthInformation(vt[0]);Pt&&Pt.isValid&&Pt.texture&&m.init(Pt,s.renderState)}if(pt&&pt.includes("camera-access")&&b){t.state.unbindTexture(),u=n.getBinding();for(let Pt=0;Pt<vt.length;Pt++){let jt=vt[Pt].camera;if(jt){let he=g[jt];he||(he=new Zr,g[jt]=he);let qt=u.getCameraImage(jt);he.sourceTexture=qt}}}}for(let vt=0;vt<_.length;vt++){let Ct=A[vt],pt=_[vt];Ct!==null&&pt!==void 0&&pt.update(Ct,ht,c||o)}tt&&tt(J,ht),ht.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:ht}),p=null}let Nt=new dm;Nt.setAnimationLoop(yt),this.setAnimationLoop=function(J){tt=J},this.dispose=function(){}}},zS=new Mt,_m=new Dt;_m.set(-1,0,0,0,1,0,0,0,1);function VS(i,t){function e(m,g){m.matrixAutoUpdate===!0&&m.updateMatrix(),g.value.copy(m.matrix)}function n(m,g){g.color.getRGB(m.fogColor.value,bu(i)),g.isFog?(m.fogNear.value=g.near,m.fogFar.value=g.far):g.isFogExp2&&(m.fogDensity.value=g.density)}function s(m,g,w,S,x){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(m,g):g.isMeshLambertMaterial?(r(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(m,g),u(m,g)):g.isMeshPhongMaterial?(r(m,g),h(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(m,g),d(m,g),g.isMeshPhysicalMaterial&&f(m,g,x)):g.isMeshMatcapMaterial?(r(m,g),p(m,g)):g.isMeshDepthMaterial?r(m,g):g.isMeshDistanceMaterial?(r(m,g),b(m,g)):g.isMeshNormalMaterial?r(m,g):g.isLineBasicMaterial?(o(m,g),g.isLineDashedMaterial&&a(m,g)):g.isPointsMaterial?l(m,g,w,S):g.isSpriteMaterial?c(m,g):g.isShadowMaterial?(m.color.value.copy(g.color),m.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(m,g){m.opacity.value=g.opacity,g.color&&m.diffuse.value.copy(g.color),g.emissive&&m.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(m.map.value=g.map,e(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.bumpMap&&(m.bumpMap.value=g.bumpMap,e(g.bumpMap,m.bumpMapTransform),m.bumpScale.value=g.bumpScale,g.side===tn&&(m.bumpScale.value*=-1)),g.normalMap&&(m.normalMap.value=g.normalMap,e(g.normalMap,m.normalMapTransform),m.normalScale.value.copy(g.normalScale),g.side===tn&&m.normalScale.value.negate()),g.displacementMap&&(m.displacementMap.value=g.displacementMap,e(g.displacementMap,m.displacementMapTransform),m.displacementScale.value=g.displacementScale,m.displacementBias.value=g.displacementBias),g.emissiveMap&&(m.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,m.emissiveMapTransform)),g.specularMap&&(m.specularMap.value=g.specularMap,e(g.specularMap,m.specularMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest);let w=t.get(g),S=w.envMap,x=w.envMapRotation;S&&(m.envMap.value=S,m.envMapRotation.value.setFromMatrix4(zS.makeRotationFromEuler(x)).transpose(),S.isCubeTexture&&S.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(_m),m.reflectivity.value=g.reflectivity,m.ior.value=g.ior,m.refractionRatio.value=g.refractionRatio),g.lightMap&&(m.lightMap.value=g.lightMap,m.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,m.lightMapTransform)),g.aoMap&&(m.aoMap.value=g.aoMap,m.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,m.aoMapTransform))}function o(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,g.map&&(m.map.value=g.map,e(g.map,m.mapTransform))}function a(m,g){m.dashSize.value=g.dashSize,m.totalSize.value=g.dashSize+g.gapSize,m.scale.value=g.scale}function l(m,g,w,S){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.size.value=g.size*w,m.scale.value=S*.5,g.map&&(m.map.value=g.map,e(g.map,m.uvTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function c(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.rotation.value=g.rotation,g.map&&(m.map.value=g.map,e(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function h(m,g){m.specular.value.copy(g.specular),m.shininess.value=Math.max(g.shininess,1e-4)}function u(m,g){g.gradientMap&&(m.gradientMap.value=g.gradientMap)}function d(m,g){m.metalness.value=g.metalness,g.metalnessMap&&(m.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,m.metalnessMapTransform)),m.roughness.value=g.roughness,g.roughnessMap&&(m.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,m.roughnessMapTransform)),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)}function f(m,g,w){m.ior.value=g.ior,g.diffuseRoughness>0&&(m.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),g.sheen>0&&(m.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),m.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(m.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,m.sheenColorMapTransform)),g.sheenRoughnessMap&&(m.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,m.sheenRoughnessMapTransform))),g.clearcoat>0&&(m.clearcoat.value=g.clearcoat,m.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(m.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,m.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(m.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===tn&&m.clearcoatNormalScale.value.negate())),g.dispersion>0&&(m.dispersion.value=g.dispersion),g.retroreflectivity>0&&(m.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(m.iridescence.value=g.iridescence,m.iridescenceIOR.value=g.iridescenceIOR,m.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(m.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,m.iridescenceMapTransform)),g.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),g.transmission>0&&(m.transmission.value=g.transmission,m.transmissionSamplerMap.value=w.texture,m.transmissionSamplerSize.value.set(w.width,w.height),g.transmissionMap&&(m.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,m.transmissionMapTransform)),m.thickness.value=g.thickness,g.thicknessMap&&(m.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=g.attenuationDistance,m.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(m.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(m.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=g.specularIntensity,m.specularColor.value.copy(g.specularColor),g.specularColorMap&&(m.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,m.specularColorMapTransform)),g.specularIntensityMap&&(m.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,m.specularIntensityMapTransform))}function p(m,g){g.matcap&&(m.matcap.value=g.matcap)}function b(m,g){let w=t.get(g).light;m.referencePosition.value.setFromMatrixPosition(w.matrixWorld),m.nearDistance.value=w.shadow.camera.near,m.farDistance.value=w.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function HS(i,t,e,n){let s={},r={};function o(w,S){let x=S.program;n.uniformBlockBinding(w,x,s[w.id])}function a(w,S){let x=s[w.id];x===void 0&&(p(w),x=l(w),s[w.id]=x,w.addEventListener("dispose",m));let _=S.program;n.updateUBOMapping(w,_);let A=t.render.frame;r[w.id]!==A&&(c(w),r[w.id]=A)}function l(w){let S=i.createBuffer(),x=w.__size,_=w.usage;return i.bindBuffer(i.UNIFORM_BUFFER,S),i.bufferData(i.UNIFORM_BUFFER,x,_),i.bindBuffer(i.UNIFORM_BUFFER,null),S}function c(w){let S=s[w.id],x=w.uniforms,_=w.__cache;i.bindBuffer(i.UNIFORM_BUFFER,S);for(let A=0,v=x.length;A<v;A++){let M=x[A];if(Array.isArray(M))for(let N=0,C=M.length;N<C;N++)h(M[N],A,N,_);else h(M,A,0,_)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(w,S,x,_){if(d(w,S,x,_)===!0){let A=w.__offset,v=w.value;if(Array.isArray(v)){let M=0;for(let N=0;N<v.length;N++){let C=v[N],L=b(C,!0);u(C,w.__data,M),M+=L.storage/Float32Array.BYTES_PER_ELEMENT}}else u(v,w.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,A,w.__data)}}function u(w,S,x){typeof w=="number"||typeof w=="boolean"?S[x]=w:w.isMatrix3?(S[x]=w.elements[0],S[x+1]=w.elements[1],S[x+2]=w.elements[2],S[x+3]=0,S[x+4]=w.elements[3],S[x+5]=w.elements[4],S[x+6]=w.elements[5],S[x+7]=0,S[x+8]=w.elements[6],S[x+9]=w.elements[7],S[x+10]=w.elements[8],S[x+11]=0):ArrayBuffer.isView(w)?S.set(w.subarray(0,S.length-x),x):w.toArray(S,x)}function d(w,S,x,_){let A=w.value,v=S+"_"+x;if(Array.isArray(A)){_[v]===void 0&&(_[v]=[]);let M=_[v],N=!1;for(let C=0;C<A.length;C++)f(A[C],M,C)===!0&&(N=!0);return N}return f(A,_,v)}function f(w,S,x){if(S[x]===void 0)return typeof w=="number"||typeof w=="boolean"?S[x]=w:ArrayBuffer.isView(w)?S[x]=w.slice():S[x]=w.clone(),!0;{let _=S[x];if(typeof w=="number"||typeof w=="boolean"){if(_!==w)return S[x]=w,!0}else{if(ArrayBuffer.isView(w))return!0;if(_.equals(w)===!1)return _.copy(w),!0}}return!1}function p(w){let S=w.uniforms,x=0,_=16;for(let v=0,M=S.length;v<M;v++){let N=Array.isArray(S[v])?S[v]:[S[v]];for(let C=0,L=N.length;C<L;C++){let I=N[C],F=Array.isArray(I.value)?I.value:[I.value],k=Array.isArray(S[v])||Array.isArray(I.value),B=x;for(let W=0,et=F.length;W<et;W++){let X=F[W],Q=b(X,k),tt=x%_,yt=tt%Q.boundary,Nt=tt+yt;x+=yt,Nt!==0&&_-Nt<Q.storage&&(x+=_-Nt),W===0&&(B=x),x+=Q.storage}let G=I.type==="int"?Int32Array:I.type==="uint"?Uint32Array:Float32Array;I.__data=new G((x-B)/Float32Array.BYTES_PER_ELEMENT),I.__offset=B}}let A=x%_;return A>0&&(x+=_-A),w.__size=x,w.__cache={},this}function b(w,S){let x={boundary:0,storage:0};return typeof w=="number"||typeof w=="boolean"?(x.boundary=4,x.storage=4):w.isVector2?(x.boundary=8,x.storage=8):w.isVector3||w.isColor?(x.boundary=16,x.storage=12):w.isVector4?(x.boundary=16,x.storage=16):w.isMatrix3?(x.boundary=16,x.storage=48):w.isMatrix4?(x.boundary=16,x.storage=64):w.isTexture?It("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(w)?(x.boundary=16,x.storage=w.byteLength):It("WebGLRenderer: Unsupported uniform value type.",w),S===!0&&(x.boundary=16,x.storage=Math.ceil(x.storage/16)*16),x}function m(w){let S=w.target;S.removeEventListener("dispose",m),i.deleteBuffer(s[S.id]),delete s[S.id],delete r[S.id]}function g(){for(let w in s)i.deleteBuffer(s[w]);s={},r={}}return{bind:o,update:a,dispose:g}}var GS=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),di=null;function WS(){return di===null&&(di=new Ti(GS,16,16,Yi,kn),di.name="DFG_LUT",di.minFilter=Xe,di.magFilter=Xe,di.wrapS=oi,di.wrapT=oi,di.generateMipmaps=!1,di.needsUpdate=!0),di}var Ul=class{constructor(t={}){let{canvas:e=Op(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=en}=t;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=o;let b=f,m=new Set([sl,il,io]),g=new Set([en,Mn,er,ms,el,nl]),w=new Uint32Array(4),S=new Int32Array(4),x={textures:[],min:[],max:[],resolution:[]},_=null,A=null,v=[],M=[],N=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=ui,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let C=this,L=!1,I=null,F=null,k=null,B=null;this._outputColorSpace=Cn;let G=0,W=0,et=null,X=-1,Q=null,tt=new Wt,yt=new Wt,Nt=null,J=new Ot(0),ht=0,vt=e.width,Ct=e.height,pt=1,Ft=null,Te=null,Pt=new Wt(0,0,vt,Ct),jt=new Wt(0,0,vt,Ct),he=!1,qt=new hi,Je=new Wr,Ne=!1,yn=!1,we=new Mt,ni=new P,Ve=new Wt,On={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Fn=!1;function Un(){return et===null?pt:1}let U=n;function Bn(E,O){return e.getContext(E,O)}let ve,ye,ft,De,Rt,Ut,R,T,V,nt,j,rt,ut,Y,Z,at,D,K,q,lt,st,ot,Tt;try{let E={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",At,!1),e.addEventListener("webglcontextrestored",zt,!1),e.addEventListener("webglcontextcreationerror",mt,!1),U===null){let O="webgl2";if(U=Bn(O,E),U===null)throw Bn(O)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Ht()}catch(E){throw e.removeEventListener("webglcontextlost",At,!1),e.removeEventListener("webglcontextrestored",zt,!1),e.removeEventListener("webglcontextcreationerror",mt,!1),kt("WebGLRenderer: "+E.message),E}function Ht(){ve=new e_(U),ve.init(),st=new FS(U,ve),ye=new Ww(U,ve,t,st),ft=new DS(U,ve),ye.reversedDepthBuffer&&d&&ft.buffers.depth.setReversed(!0),F=U.createFramebuffer(),k=U.createFramebuffer(),B=U.createFramebuffer(),De=new s_(U),Rt=new wS,Ut=new OS(U,ve,ft,Rt,ye,st,De),R=new t_(C),T=new oy(U),ot=new Hw(U,T),V=new n_(U,T,De,ot),nt=new o_(U,V,T,ot,De),K=new r_(U,ye,Ut),Z=new $w(Rt),j=new bS(C,R,ve,ye,ot,Z),rt=new VS(C,Rt),ut=new SS,Y=new PS(ve),D=new Vw(C,R,ft,nt,p,l),at=new NS(C,nt,ye),Tt=new HS(U,De,ye,ft),q=new Gw(U,ve,De),lt=new i_(U,ve,De),De.programs=j.programs,C.capabilities=ye,C.extensions=ve,C.properties=Rt,C.renderLists=ut,C.shadowMap=at,C.state=ft,C.info=De}b!==en&&(N=new l_(b,e.width,e.height,a,s,r));let it=new ku(C,U);this.xr=it,this.getContext=function(){return U},this.getContextAttributes=function(){return U.getContextAttributes()},this.forceContextLoss=function(){let E=ve.get("WEBGL_lose_context");E&&E.loseContext()},this.forceContextRestore=function(){let E=ve.get("WEBGL_lose_context");E&&E.restoreContext()},this.getPixelRatio=function(){return pt},this.setPixelRatio=function(E){E!==void 0&&(pt=E,this.setSize(vt,Ct,!1))},this.getSize=function(E){return E.set(vt,Ct)},this.setSize=function(E,O,$=!0){if(it.isPresenting){It("WebGLRenderer: Can't change size while VR device is presenting.");return}vt=E,Ct=O,e.width=Math.floor(E*pt),e.height=Math.floor(O*pt),$===!0&&(e.style.width=E+"px",e.style.height=O+"px"),N!==null&&N.setSize(e.width,e.height),this.setViewport(0,0,E,O)},this.getDrawingBufferSize=function(E){return E.set(vt*pt,Ct*pt).floor()},this.setDrawingBufferSize=function(E,O,$){vt=E,Ct=O,pt=$,e.width=Math.floor(E*$),e.height=Math.floor(O*$),this.setViewport(0,0,E,O)},this.setEffects=function(E){if(b===en){kt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(E){for(let O=0;O<E.length;O++)if(E[O].isOutputPass===!0){It("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}N.setEffects(E||[])},this.getCurrentViewport=function(E){return E.copy(tt)},this.getViewport=function(E){return E.copy(Pt)},this.setViewport=function(E,O,$,z){E.isVector4?Pt.set(E.x,E.y,E.z,E.w):Pt.set(E,O,$,z),ft.viewport(tt.copy(Pt).multiplyScalar(Un()).round())},this.getScissor=function(E){return E.copy(jt)},this.setScissor=function(E,O,$,z){E.isVector4?jt.set(E.x,E.y,E.z,E.w):jt.set(E,O,$,z),ft.scissor(yt.copy(jt).multiplyScalar(Un()).round())},this.getScissorTest=function(){return he},this.setScissorTest=function(E){ft.setScissorTest(he=E)},this.setOpaqueSort=function(E){Ft=E},this.setTransparentSort=function(E){Te=E},this.getClearColor=function(E){return E.copy(D.getClearColor())},this.setClearColor=function(){D.setClearColor(...arguments)},this.getClearAlpha=function(){return D.getClearAlpha()},this.setClearAlpha=function(){D.setClearAlpha(...arguments)},this.clear=function(E=!0,O=!0,$=!0){let z=0;if(E){let H=!1;if(et!==null){let dt=et.texture.format;H=m.has(dt)}if(H){let dt=et.texture.type,bt=g.has(dt),ct=D.getClearColor(),xt=D.getClearAlpha(),St=ct.r,Bt=ct.g,Yt=ct.b;bt?(w[0]=St,w[1]=Bt,w[2]=Yt,w[3]=xt,U.clearBufferuiv(U.COLOR,0,w)):(S[0]=St,S[1]=Bt,S[2]=Yt,S[3]=xt,U.clearBufferiv(U.COLOR,0,S))}else z|=U.COLOR_BUFFER_BIT}O&&(z|=U.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),$&&(z|=U.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),z!==0&&U.clear(z)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(E){E.setRenderer(this),I=E},this.dispose=function(){e.removeEventListener("webglcontextlost",At,!1),e.removeEventListener("webglcontextrestored",zt,!1),e.removeEventListener("webglcontextcreationerror",mt,!1),D.dispose(),ut.dispose(),Y.dispose(),Ut.dispose(),Rt.dispose(),R.dispose(),nt.dispose(),V.dispose(),ot.dispose(),Tt.dispose(),j.dispose(),it.dispose(),it.removeEventListener("sessionstart",Qd),it.removeEventListener("sessionend",tf),rs.stop()};function At(E){E.preventDefault(),vu("WebGLRenderer: Context Lost."),L=!0}function zt(){vu("WebGLRenderer: Context Restored."),L=!1;let E=De.autoReset,O=at.enabled,$=at.autoUpdate,z=at.needsUpdate,H=at.type;Ht(),De.autoReset=E,at.enabled=O,at.autoUpdate=$,at.needsUpdate=z,at.type=H}function mt(E){kt("WebGLRenderer: A WebGL context could not be created. Reason: ",E.statusMessage)}function ae(E){let O=E.target;O.removeEventListener("dispose",ae),He(O)}function He(E){Ni(E),Rt.remove(E)}function Ni(E){let O=Rt.get(E).programs;O!==void 0&&(O.forEach(function($){j.releaseProgram($)}),E.isShaderMaterial&&j.releaseShaderCache(E))}this.renderBufferDirect=function(E,O,$,z,H,dt){O===null&&(O=On);let bt=H.isMesh&&H.matrixWorld.determinantAffine()<0,ct=Xx(E,O,$,z,H);ft.setMaterial(z,bt);let xt=$.index,St=1;if(z.wireframe===!0){if(xt=V.getWireframeAttribute($),xt===void 0)return;St=2}let Bt=$.drawRange,Yt=$.attributes.position,wt=Bt.start*St,Zt=(Bt.start+Bt.count)*St;dt!==null&&(wt=Math.max(wt,dt.start*St),Zt=Math.min(Zt,(dt.start+dt.count)*St)),xt!==null?(wt=Math.max(wt,0),Zt=Math.min(Zt,xt.count)):Yt!=null&&(wt=Math.max(wt,0),Zt=Math.min(Zt,Yt.count));let Ce=Zt-wt;if(Ce<0||Ce===1/0)return;ot.setup(H,z,ct,$,xt);let me,ue=q;if(xt!==null&&(me=T.get(xt),ue=lt,ue.setIndex(me)),H.isMesh)z.wireframe===!0?(ft.setLineWidth(z.wireframeLinewidth*Un()),ue.setMode(U.LINES)):ue.setMode(U.TRIANGLES);else if(H.isLine){let sn=z.linewidth;sn===void 0&&(sn=1),ft.setLineWidth(sn*Un()),H.isLineSegments?ue.setMode(U.LINES):H.isLineLoop?ue.setMode(U.LINE_LOOP):ue.setMode(U.LINE_STRIP)}else H.isPoints?ue.setMode(U.POINTS):H.isSprite&&ue.setMode(U.TRIANGLES);if(H.isBatchedMesh)if(ve.get("WEBGL_multi_draw"))ue.renderMultiDraw(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount);else{let sn=H._multiDrawStarts,_t=H._multiDrawCounts,fn=H._multiDrawCount,te=xt?T.get(xt).bytesPerElement:1,os=Rt.get(z).currentProgram.getUniforms();for(let rn=0;rn<fn;rn++)os.setValue(U,"_gl_DrawID",rn),ue.render(sn[rn]/te,_t[rn])}else if(H.isInstancedMesh)ue.renderInstances(wt,Ce,H.count);else if($.isInstancedBufferGeometry){let sn=$._maxInstanceCount!==void 0?$._maxInstanceCount:1/0,_t=Math.min($.instanceCount,sn);ue.renderInstances(wt,Ce,_t)}else ue.render(wt,Ce)};function jd(E,O,$,z){I!==null&&E.isNodeMaterial&&I.setObject(z,E),Ne===!0&&Z.setState(E,$,!1),E.transparent===!0&&E.side===Oe&&E.forceSinglePass===!1?(E.side=tn,E.needsUpdate=!0,Cr(E,O,z),E.side=jn,E.needsUpdate=!0,Cr(E,O,z),E.side=Oe):Cr(E,O,z)}this.compile=function(E,O,$=null){$===null&&($=E),I!==null&&I.renderStart(E,O,$),A=Y.get($),A.init(O),M.push(A),$.traverseVisible(function(H){H.isLight&&H.layers.test(O.layers)&&(A.pushLight(H),H.castShadow&&A.pushShadow(H))}),E!==$&&E.traverseVisible(function(H){H.isLight&&H.layers.test(O.layers)&&(A.pushLight(H),H.castShadow&&A.pushShadow(H))}),A.setupLights(),I!==null&&I.updateLights(A.state.lightsArray),yn=this.localClippingEnabled,Ne=Z.init(this.clippingPlanes,yn),Ne===!0&&Z.setGlobalState(this.clippingPlanes,O),I!==null&&at.render(A.state.shadowsArray,$,O);let z=new Set;return E.traverse(function(H){if(!(H.isMesh||H.isPoints||H.isLine||H.isSprite))return;let dt=H.material;if(dt)if(Array.isArray(dt))for(let bt=0;bt<dt.length;bt++){let ct=dt[bt];jd(ct,$,O,H),z.add(ct)}else jd(dt,$,O,H),z.add(dt)}),A=M.pop(),I!==null&&I.renderEnd(),z},this.compileAsync=function(E,O,$=null){let z=this.compile(E,O,$);return new Promise(H=>{function dt(){if(z.forEach(function(bt){let xt=Rt.get(bt).currentProgram;(xt===void 0||xt.isReady())&&z.delete(bt)}),z.size===0){H(E);return}setTimeout(dt,10)}ve.get("KHR_parallel_shader_compile")!==null?dt():setTimeout(dt,10)})};let rh=null;function Wx(E){rh&&rh(E)}function Qd(){rs.stop()}function tf(){rs.start()}let rs=new dm;rs.setAnimationLoop(Wx),typeof self<"u"&&rs.setContext(self),this.setAnimationLoop=function(E){rh=E,it.setAnimationLoop(E),E===null?rs.stop():rs.start()},it.addEventListener("sessionstart",Qd),it.addEventListener("sessionend",tf),this.render=function(E,O){if(O!==void 0&&O.isCamera!==!0){kt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(L===!0)return;I!==null&&I.renderStart(E,O);let $=it.enabled===!0&&it.isPresenting===!0,z=N!==null&&(et===null||$)&&N.begin(C,et);if(E.matrixWorldAutoUpdate===!0&&E.updateMatrixWorld(),O.parent===null&&O.matrixWorldAutoUpdate===!0&&O.updateMatrixWorld(),it.enabled===!0&&it.isPresenting===!0&&(N===null||N.isCompositing()===!1)&&(it.cameraAutoUpdate===!0&&it.updateCamera(O),O=it.getCamera()),E.isScene===!0&&E.onBeforeRender(C,E,O,et),A=Y.get(E,M.length),A.init(O),A.state.textureUnits=Ut.getTextureUnits(),M.push(A),we.multiplyMatrices(O.projectionMatrix,O.matrixWorldInverse),O.isArrayCamera?Je.setFromArrayCamera(O):qt.setFromProjectionMatrix(we,Hn,O.reversedDepth),yn=this.localClippingEnabled,Ne=Z.init(this.clippingPlanes,yn),_=ut.get(E,v.length),_.init(),v.push(_),this.info.render.frame++,it.enabled===!0&&it.isPresenting===!0){let bt=C.xr.getDepthSensingMesh();bt!==null&&oh(bt,O,-1/0,C.sortObjects)}oh(E,O,0,C.sortObjects),_.finish(),I!==null&&I.updateLights(A.state.lightsArray),C.sortObjects===!0&&_.sort(Ft,Te),Fn=it.enabled===!1||it.isPresenting===!1||it.hasDepthSensing()===!1,Fn&&D.addToRenderList(_,E),this.info.autoReset===!0&&this.info.reset(),Ne===!0&&Z.beginShadows();let H=A.state.shadowsArray;if(at.render(H,E,O),Ne===!0&&Z.endShadows(),(z&&N.hasRenderPass())===!1){let bt=_.opaque,ct=_.transmissive;if(A.setupLights(),O.isArrayCamera){let xt=O.cameras;if(ct.length>0)for(let St=0,Bt=xt.length;St<Bt;St++){let Yt=xt[St];nf(bt,ct,E,Yt)}Fn&&D.render(E);for(let St=0,Bt=xt.length;St<Bt;St++){let Yt=xt[St];ef(_,E,Yt,Yt.viewport)}}else ct.length>0&&nf(bt,ct,E,O),Fn&&D.render(E),ef(_,E,O)}et!==null&&W===0&&(Ut.updateMultisampleRenderTarget(et),Ut.updateRenderTargetMipmap(et)),z&&N.end(C),E.isScene===!0&&E.onAfterRender(C,E,O),ot.resetDefaultState(),X=-1,Q=null,M.pop(),M.length>0?(A=M[M.length-1],Ut.setTextureUnits(A.state.textureUnits),Ne===!0&&Z.setGlobalState(C.clippingPlanes,A.state.camera)):A=null,v.pop(),v.length>0?_=v[v.length-1]:_=null,I!==null&&I.renderEnd()};function oh(E,O,$,z){if(E.visible===!1)return;if(E.layers.test(O.layers)){if(E.isGroup)$=E.renderOrder;else if(E.isLOD)E.autoUpdate===!0&&E.update(O);else if(E.isLight)A.pushLight(E),E.castShadow&&A.pushShadow(E);else if(E.isSprite){let bt=O.isArrayCamera?Je:qt;if(!E.frustumCulled||E.intersectsFrustum(bt)){z&&Ve.setFromMatrixPosition(E.matrixWorld).applyMatrix4(we);let ct=nt.update(E),xt=E.material;xt.visible&&_.push(E,ct,xt,$,Ve.z,null,O)}}else if(E.isMesh||E.isLine||E.isPoints){let bt=O.isArrayCamera?Je:qt;if(!E.frustumCulled||E.intersectsFrustum(bt)){let ct=nt.update(E),xt=E.material;if(z&&(E.boundingSphere!==void 0?(E.boundingSphere===null&&E.computeBoundingSphere(),Ve.copy(E.boundingSphere.center)):(ct.boundingSphere===null&&ct.computeBoundingSphere(),Ve.copy(ct.boundingSphere.center)),Ve.applyMatrix4(E.matrixWorld).applyMatrix4(we)),Array.isArray(xt)){let St=ct.groups;for(let Bt=0,Yt=St.length;Bt<Yt;Bt++){let wt=St[Bt],Zt=xt[wt.materialIndex];Zt&&Zt.visible&&_.push(E,ct,Zt,$,Ve.z,wt,O)}}else xt.visible&&_.push(E,ct,xt,$,Ve.z,null,O)}}}let dt=E.children;for(let bt=0,ct=dt.length;bt<ct;bt++)oh(dt[bt],O,$,z)}function ef(E,O,$,z){let{opaque:H,transmissive:dt,transparent:bt}=E;A.setupLightsView($),Ne===!0&&Z.setGlobalState(C.clippingPlanes,$),z&&ft.viewport(tt.copy(z)),H.length>0&&Do(H,O,$),dt.length>0&&Do(dt,O,$),bt.length>0&&Do(bt,O,$),ft.buffers.depth.setTest(!0),ft.buffers.depth.setMask(!0),ft.buffers.color.setMask(!0),ft.setPolygonOffset(!1)}function nf(E,O,$,z){if(($.isScene===!0?$.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[z.id]===void 0){let wt=ve.has("EXT_color_buffer_half_float")||ve.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[z.id]=new Re(1,1,{generateMipmaps:!0,type:wt?kn:en,minFilter:Ci,samples:Math.max(4,ye.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:$t.workingColorSpace})}let dt=A.state.transmissionRenderTarget[z.id],bt=z.viewport||tt;dt.setSize(bt.z*C.transmissionResolutionScale,bt.w*C.transmissionResolutionScale);let ct=C.getRenderTarget(),xt=C.getActiveCubeFace(),St=C.getActiveMipmapLevel();C.setRenderTarget(dt),C.getClearColor(J),ht=C.getClearAlpha(),ht<1&&C.setClearColor(16777215,.5),C.clear(),Fn&&D.render($);let Bt=C.toneMapping;C.toneMapping=ui;let Yt=z.viewport;if(z.viewport!==void 0&&(z.viewport=void 0),A.setupLightsView(z),Ne===!0&&Z.setGlobalState(C.clippingPlanes,z),Do(E,$,z),Ut.updateMultisampleRenderTarget(dt),Ut.updateRenderTargetMipmap(dt),ve.has("WEBGL_multisampled_render_to_texture")===!1){let wt=!1;for(let Zt=0,Ce=O.length;Zt<Ce;Zt++){let me=O[Zt],{object:ue,geometry:sn,material:_t,group:fn}=me;if(_t.side===Oe&&ue.layers.test(z.layers)){let te=_t.side;_t.side=tn,_t.needsUpdate=!0,sf(ue,$,z,sn,_t,fn),_t.side=te,_t.needsUpdate=!0,wt=!0}}wt===!0&&(Ut.updateMultisampleRenderTarget(dt),Ut.updateRenderTargetMipmap(dt))}C.setRenderTarget(ct,xt,St),C.setClearColor(J,ht),Yt!==void 0&&(z.viewport=Yt),C.toneMapping=Bt}function Do(E,O,$){let z=O.isScene===!0?O.overrideMaterial:null;for(let H=0,dt=E.length;H<dt;H++){let bt=E[H],{object:ct,geometry:xt,group:St}=bt,Bt=bt.material;Bt.allowOverride===!0&&z!==null&&(Bt=z),ct.layers.test($.layers)&&sf(ct,O,$,xt,Bt,St)}}function sf(E,O,$,z,H,dt){I!==null&&H.isNodeMaterial&&I.setObject(E,H),E.onBeforeRender(C,O,$,z,H,dt),E.modelViewMatrix.multiplyMatrices($.matrixWorldInverse,E.matrixWorld),E.normalMatrix.getNormalMatrix(E.modelViewMatrix),H.onBeforeRender(C,O,$,z,E,dt),H.transparent===!0&&H.side===Oe&&H.forceSinglePass===!1?(H.side=tn,H.needsUpdate=!0,C.renderBufferDirect($,O,z,H,E,dt),H.side=jn,H.needsUpdate=!0,C.renderBufferDirect($,O,z,H,E,dt),H.side=Oe):C.renderBufferDirect($,O,z,H,E,dt),E.onAfterRender(C,O,$,z,H,dt)}function rf(E){let O=0;for(let $ of E)$.texture!==null&&O++;return O}function Cr(E,O,$){O.isScene!==!0&&(O=On);let z=Rt.get(E),H=A.state.lights,dt=A.state.shadowsArray,bt=H.state.version,ct=j.getParameters(E,H.state,dt,O,$,A.state.lightProbeGridArray),xt=j.getProgramCacheKey(ct),St=z.programs;z.environment=E.isMeshStandardMaterial||E.isMeshLambertMaterial||E.isMeshPhongMaterial?O.environment:null,z.fog=O.fog;let Bt=E.isMeshStandardMaterial||E.isMeshLambertMaterial&&!E.envMap||E.isMeshPhongMaterial&&!E.envMap;z.envMap=R.get(E.envMap||z.environment,Bt),z.envMapRotation=z.environment!==null&&E.envMap===null?O.environmentRotation:E.envMapRotation,St===void 0&&(E.addEventListener("dispose",ae),St=new Map,z.programs=St,z.programVariants=new Map);let Yt=St.get(xt);if(Yt!==void 0){if(z.currentProgram===Yt&&z.lightsStateVersion===bt)return af(E,ct),Yt}else ct.uniforms=j.getUniforms(E),I!==null&&E.isNodeMaterial&&I.build(E,$,ct),E.onBeforeCompile(ct,C),Yt=j.acquireProgram(ct,xt),St.set(xt,Yt),z.uniforms=ct.uniforms;let wt=z.uniforms;return(!E.isShaderMaterial&&!E.isRawShaderMaterial||E.clipping===!0)&&(wt.clippingPlanes=Z.uniform),af(E,ct),z.needsLights=Yx(E),z.lightsStateVersion=bt,z.needsLights&&(wt.ambientLightColor.value=H.state.ambient,wt.lightProbe.value=H.state.probe,wt.sunLights.value=H.state.sun,wt.sunLightShadows.value=H.state.sunShadow,wt.directionalLights.value=H.state.directional,wt.directionalLightShadows.value=H.state.directionalShadow,wt.spotLights.value=H.state.spot,wt.spotLightShadows.value=H.state.spotShadow,wt.rectAreaLights.value=H.state.rectArea,wt.ltc_1.value=H.state.rectAreaLTC1,wt.ltc_2.value=H.state.rectAreaLTC2,wt.pointLights.value=H.state.point,wt.pointLightShadows.value=H.state.pointShadow,wt.hemisphereLights.value=H.state.hemi,wt.sunShadowMatrix.value=H.state.sunShadowMatrix,wt.sunShadowCascade.value=H.state.sunShadowCascade,wt.directionalShadowMatrix.value=H.state.directionalShadowMatrix,wt.spotLightMatrix.value=H.state.spotLightMatrix,wt.spotLightMap.value=H.state.spotLightMap,wt.pointShadowMatrix.value=H.state.pointShadowMatrix),z.numLightProbeGrids=rf(A.state.lightProbeGridArray),z.currentProgram=Yt,z.uniformsList=null,Yt}function $x(E,O,$,z,H){let dt=Rt.get(E),bt=dt.currentProgram.id+","+z+","+H,ct=dt.programVariants.get(bt);return ct===void 0?(ct=Cr(E,O,$),dt.programVariants.set(bt,ct)):(dt.currentProgram=ct,dt.uniformsList=null,dt.outputColorSpace=z,dt.toneMapping=H),ct}function of(E){if(E.uniformsList===null){let O=E.currentProgram.getUniforms();E.uniformsList=nr.seqWithValue(O.seq,E.uniforms)}return E.uniformsList}function af(E,O){let $=Rt.get(E);$.outputColorSpace=O.outputColorSpace,$.batching=O.batching,$.batchingColor=O.batchingColor,$.instancing=O.instancing,$.instancingColor=O.instancingColor,$.instancingMorph=O.instancingMorph,$.skinning=O.skinning,$.morphTargets=O.morphTargets,$.morphNormals=O.morphNormals,$.morphColors=O.morphColors,$.morphTargetsCount=O.morphTargetsCount,$.numClippingPlanes=O.numClippingPlanes,$.numIntersection=O.numClipIntersection,$.vertexAlphas=O.vertexAlphas,$.vertexTangents=O.vertexTangents,$.toneMapping=O.toneMapping}function Xx(E,O,$,z,H){O.isScene!==!0&&(O=On),Ut.resetTextureUnits();let dt=O.fog,bt=z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial?O.environment:null,ct=et===null?C.outputColorSpace:et.isXRRenderTarget===!0?et.texture.colorSpace:$t.workingColorSpace,xt=z.isMeshStandardMaterial||z.isMeshLambertMaterial&&!z.envMap||z.isMeshPhongMaterial&&!z.envMap,St=R.get(z.envMap||bt,xt),Bt=z.vertexColors===!0&&!!$.attributes.color&&$.attributes.color.itemSize===4,Yt=!!$.attributes.tangent&&(!!z.normalMap||z.anisotropy>0),wt=!!$.morphAttributes.position,Zt=!!$.morphAttributes.normal,Ce=!!$.morphAttributes.color,me=ui;z.toneMapped&&(et===null||et.isXRRenderTarget===!0)&&(me=C.toneMapping);let ue=$.morphAttributes.position||$.morphAttributes.normal||$.morphAttributes.color,sn=ue!==void 0?ue.length:0,_t=Rt.get(z),fn=A.state.lights;if(Ne===!0&&(yn===!0||E!==Q)){let _e=E===Q&&z.id===X;Z.setState(z,E,_e)}let te=!1,os=!1;z.version===_t.__version?_t.needsLights&&_t.lightsStateVersion!==fn.state.version||H.isBatchedMesh&&_t.batching===!1||!H.isBatchedMesh&&_t.batching===!0||H.isBatchedMesh&&_t.batchingColor===!0&&H._colorsTexture===null||H.isBatchedMesh&&_t.batchingColor===!1&&H._colorsTexture!==null||H.isInstancedMesh&&_t.instancing===!1||!H.isInstancedMesh&&_t.instancing===!0||H.isSkinnedMesh&&_t.skinning===!1||!H.isSkinnedMesh&&_t.skinning===!0||H.isInstancedMesh&&_t.instancingColor===!0&&H.instanceColor===null||H.isInstancedMesh&&_t.instancingColor===!1&&H.instanceColor!==null||H.isInstancedMesh&&_t.instancingMorph===!0&&H.morphTexture===null||H.isInstancedMesh&&_t.instancingMorph===!1&&H.morphTexture!==null||_t.envMap!==St||z.fog===!0&&_t.fog!==dt||_t.numClippingPlanes!==void 0&&(_t.numClippingPlanes!==Z.numPlanes||_t.numIntersection!==Z.numIntersection)||_t.vertexAlphas!==Bt||_t.vertexTangents!==Yt||_t.morphTargets!==wt||_t.morphNormals!==Zt||_t.morphColors!==Ce||_t.morphTargetsCount!==sn||_t.numLightProbeGrids!==rf(A.state.lightProbeGridArray)?te=!0:(_t.outputColorSpace!==ct||_t.toneMapping!==me)&&(os=!0):(te=!0,_t.__version=z.version);let rn=_t.currentProgram;(te===!0||os===!0)&&(rn=os===!0?$x(z,O,H,ct,me):Cr(z,O,H),I&&z.isNodeMaterial&&I.onUpdateProgram(z,rn,_t));let Oo=!1,Di=!1,as=!1,Qt=rn.getUniforms(),Ke=_t.uniforms;if(ft.useProgram(rn.program)&&(Oo=!0,Di=!0,as=!0),z.id!==X&&(X=z.id,Di=!0),Oo||Q!==E){ft.buffers.depth.getReversed()&&E.reversedDepth!==!0&&(E._reversedDepth=!0,E.updateProjectionMatrix()),Qt.setValue(U,"projectionMatrix",E.projectionMatrix),Qt.setValue(U,"viewMatrix",E.matrixWorldInverse);let Ge=Qt.map.cameraPosition;Ge!==void 0&&Ge.setValue(U,ni.setFromMatrixPosition(E.matrixWorld)),ye.logarithmicDepthBuffer&&Qt.setValue(U,"logDepthBufFC",2/(Math.log(E.far+1)/Math.LN2)),(z.isMeshPhongMaterial||z.isMeshToonMaterial||z.isMeshLambertMaterial||z.isMeshBasicMaterial||z.isMeshStandardMaterial||z.isShaderMaterial)&&Qt.setValue(U,"isOrthographic",E.isOrthographicCamera===!0),Q!==E&&(Q=E,Di=!0,as=!0)}if(_t.needsLights&&(fn.state.sunShadowMap.length>0&&Qt.setValue(U,"sunShadowMap",fn.state.sunShadowMap,Ut),fn.state.directionalShadowMap.length>0&&Qt.setValue(U,"directionalShadowMap",fn.state.directionalShadowMap,Ut),fn.state.spotShadowMap.length>0&&Qt.setValue(U,"spotShadowMap",fn.state.spotShadowMap,Ut),fn.state.pointShadowMap.length>0&&Qt.setValue(U,"pointShadowMap",fn.state.pointShadowMap,Ut)),H.isSkinnedMesh){Qt.setOptional(U,H,"bindMatrix"),Qt.setOptional(U,H,"bindMatrixInverse");let _e=H.skeleton;_e&&(_e.boneTexture===null&&_e.computeBoneTexture(),Qt.setValue(U,"boneTexture",_e.boneTexture,Ut))}H.isBatchedMesh&&(Qt.setOptional(U,H,"batchingTexture"),Qt.setValue(U,"batchingTexture",H._matricesTexture,Ut),Qt.setOptional(U,H,"batchingIdTexture"),Qt.setValue(U,"batchingIdTexture",H._indirectTexture,Ut),Qt.setOptional(U,H,"batchingColorTexture"),H._colorsTexture!==null&&Qt.setValue(U,"batchingColorTexture",H._colorsTexture,Ut));let Xn=$.morphAttributes;if((Xn.position!==void 0||Xn.normal!==void 0||Xn.color!==void 0)&&K.update(H,$,rn),(Di||_t.receiveShadow!==H.receiveShadow)&&(_t.receiveShadow=H.receiveShadow,Qt.setValue(U,"receiveShadow",H.receiveShadow)),(z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial)&&z.envMap===null&&O.environment!==null&&(Ke.envMapIntensity.value=O.environmentIntensity),Ke.dfgLUT!==void 0&&(Ke.dfgLUT.value=WS()),Di){if(Qt.setValue(U,"toneMappingExposure",C.toneMappingExposure),_t.needsLights&&qx(Ke,as),dt&&z.fog===!0&&rt.refreshFogUniforms(Ke,dt),rt.refreshMaterialUniforms(Ke,z,pt,Ct,A.state.transmissionRenderTarget[E.id]),_t.needsLights&&_t.numLightProbeGrids>0){let _e=x,Ge=0;for(let vi of A.state.lightProbeGridArray)vi.texture!==null&&(_e.textures[Ge]=vi.texture,_e.min[Ge]=vi.boundingBox.min,_e.max[Ge]=vi.boundingBox.max,_e.resolution[Ge]=vi.resolution,Ge++);for(let vi in _e)_e[vi].length=Ge;Ke.probesSH.value=_e.textures,Ke.probesMin.value=_e.min,Ke.probesMax.value=_e.max,Ke.probesResolution.value=_e.resolution}nr.upload(U,of(_t),Ke,Ut)}if(z.isShaderMaterial&&z.uniformsNeedUpdate===!0&&(nr.upload(U,of(_t),Ke,Ut),z.uniformsNeedUpdate=!1),z.isSpriteMaterial&&Qt.setValue(U,"center",H.center),Qt.setValue(U,"modelViewMatrix",H.modelViewMatrix),Qt.setValue(U,"normalMatrix",H.normalMatrix),Qt.setValue(U,"modelMatrix",H.matrixWorld),z.uniformsGroups!==void 0){let _e=z.uniformsGroups;for(let Ge=0,vi=_e.length;Ge<vi;Ge++){let cf=_e[Ge];Tt.update(cf,rn),Tt.bind(cf,rn)}}return rn}function qx(E,O){E.ambientLightColor.needsUpdate=O,E.lightProbe.needsUpdate=O,E.sunLights.needsUpdate=O,E.sunLightShadows.needsUpdate=O,E.directionalLights.needsUpdate=O,E.directionalLightShadows.needsUpdate=O,E.pointLights.needsUpdate=O,E.pointLightShadows.needsUpdate=O,E.spotLights.needsUpdate=O,E.spotLightShadows.needsUpdate=O,E.rectAreaLights.needsUpdate=O,E.hemisphereLights.needsUpdate=O}function Yx(E){return E.isMeshLambertMaterial||E.isMeshToonMaterial||E.isMeshPhongMaterial||E.isMeshStandardMaterial||E.isShadowMaterial||E.isShaderMaterial&&E.lights===!0}this.getActiveCubeFace=function(){return G},this.getActiveMipmapLevel=function(){return W},this.getRenderTarget=function(){return et},this.setRenderTargetTextures=function(E,O,$){let z=Rt.get(E);z.__autoAllocateDepthBuffer=E.resolveDepthBuffer===!1,z.__autoAllocateDepthBuffer===!1&&(z.__useRenderToTexture=!1),Rt.get(E.texture).__webglTexture=O,Rt.get(E.depthTexture).__webglTexture=z.__autoAllocateDepthBuffer?void 0:$,z.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(E,O){let $=Rt.get(E);$.__webglFramebuffer=O,$.__useDefaultFramebuffer=O===void 0},this.setRenderTarget=function(E,O=0,$=0){et=E,G=O,W=$;let z=null,H=!1,dt=!1;if(E){let ct=Rt.get(E);if(ct.__useDefaultFramebuffer!==void 0){ft.bindFramebuffer(U.FRAMEBUFFER,ct.__webglFramebuffer),tt.copy(E.viewport),yt.copy(E.scissor),Nt=E.scissorTest,ft.viewport(tt),ft.scissor(yt),ft.setScissorTest(Nt),X=-1;return}else if(ct.__webglFramebuffer===void 0)Ut.setupRenderTarget(E);else if(ct.__hasExternalTextures)Ut.rebindTextures(E,Rt.get(E.texture).__webglTexture,Rt.get(E.depthTexture).__webglTexture);else if(E.depthBuffer){let Bt=E.depthTexture;if(ct.__boundDepthTexture!==Bt){if(Bt!==null&&Rt.has(Bt)&&(E.width!==Bt.image.width||E.height!==Bt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ut.setupDepthRenderbuffer(E)}}let xt=E.texture;(xt.isData3DTexture||xt.isDataArrayTexture||xt.isCompressedArrayTexture)&&(dt=!0);let St=Rt.get(E).__webglFramebuffer;E.isWebGLCubeRenderTarget?(Array.isArray(St[O])?z=St[O][$]:z=St[O],H=!0):E.samples>0&&Ut.useMultisampledRTT(E)===!1?z=Rt.get(E).__webglMultisampledFramebuffer:Array.isArray(St)?z=St[$]:z=St,tt.copy(E.viewport),yt.copy(E.scissor),Nt=E.scissorTest}else tt.copy(Pt).multiplyScalar(pt).floor(),yt.copy(jt).multiplyScalar(pt).floor(),Nt=he;if($!==0&&(z=F),ft.bindFramebuffer(U.FRAMEBUFFER,z)&&ft.drawBuffers(E,z),ft.viewport(tt),ft.scissor(yt),ft.setScissorTest(Nt),H){let ct=Rt.get(E.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_CUBE_MAP_POSITIVE_X+O,ct.__webglTexture,$)}else if(dt){let ct=O;for(let xt=0;xt<E.textures.length;xt++){let St=Rt.get(E.textures[xt]);U.framebufferTextureLayer(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0+xt,St.__webglTexture,$,ct)}}else if(E!==null&&$!==0){let ct=Rt.get(E.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,ct.__webglTexture,$)}X=-1};function lf(E){let O=Rt.get(E);return(O.__readFormat!==E.format||O.__readType!==E.type)&&(O.__readFormat=E.format,O.__readType=E.type,O.__formatReadable=ye.textureFormatReadable(E.format),O.__typeReadable=ye.textureTypeReadable(E.type)),O}this.readRenderTargetPixels=function(E,O,$,z,H,dt,bt,ct=0){if(!(E&&E.isWebGLRenderTarget)){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let xt=Rt.get(E).__webglFramebuffer;if(E.isWebGLCubeRenderTarget&&bt!==void 0&&(xt=xt[bt],Array.isArray(xt)&&(xt=xt[0])),xt){ft.bindFramebuffer(U.FRAMEBUFFER,xt);try{let St=E.textures[ct],Bt=St.format,Yt=St.type;E.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+ct);let wt=lf(St);if(wt.__formatReadable===!1){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(wt.__typeReadable===!1){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}O>=0&&O<=E.width-z&&$>=0&&$<=E.height-H&&U.readPixels(O,$,z,H,st.convert(Bt),st.convert(Yt),dt)}finally{let St=et!==null?Rt.get(et).__webglFramebuffer:null;ft.bindFramebuffer(U.FRAMEBUFFER,St)}}},this.readRenderTargetPixelsAsync=async function(E,O,$,z,H,dt,bt,ct=0){if(!(E&&E.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let xt=Rt.get(E).__webglFramebuffer;if(E.isWebGLCubeRenderTarget&&bt!==void 0&&(xt=xt[bt],Array.isArray(xt)&&(xt=xt[0])),xt)if(O>=0&&O<=E.width-z&&$>=0&&$<=E.height-H){ft.bindFramebuffer(U.FRAMEBUFFER,xt);let St=E.textures[ct],Bt=St.format,Yt=St.type;E.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+ct);let wt=lf(St);if(wt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(wt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Zt=U.createBuffer();U.bindBuffer(U.PIXEL_PACK_BUFFER,Zt),U.bufferData(U.PIXEL_PACK_BUFFER,dt.byteLength,U.STREAM_READ),U.readPixels(O,$,z,H,st.convert(Bt),st.convert(Yt),0),U.bindBuffer(U.PIXEL_PACK_BUFFER,null);let Ce=et!==null?Rt.get(et).__webglFramebuffer:null;ft.bindFramebuffer(U.FRAMEBUFFER,Ce);let me=U.fenceSync(U.SYNC_GPU_COMMANDS_COMPLETE,0);return U.flush(),await Up(U,me,4),U.bindBuffer(U.PIXEL_PACK_BUFFER,Zt),U.getBufferSubData(U.PIXEL_PACK_BUFFER,0,dt),U.bindBuffer(U.PIXEL_PACK_BUFFER,null),U.deleteBuffer(Zt),U.deleteSync(me),dt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(E,O=null,$=0){let z=Math.pow(2,-$),H=Math.floor(E.image.width*z),dt=Math.floor(E.image.height*z),bt=O!==null?O.x:0,ct=O!==null?O.y:0;Ut.setTexture2D(E,0),U.copyTexSubImage2D(U.TEXTURE_2D,$,0,0,bt,ct,H,dt),ft.unbindTexture()},this.copyTextureToTexture=function(E,O,$=null,z=null,H=0,dt=0){let bt,ct,xt,St,Bt,Yt,wt,Zt,Ce,me=E.isCompressedTexture?E.mipmaps[dt]:E.image;if($!==null)bt=$.max.x-$.min.x,ct=$.max.y-$.min.y,xt=$.isBox3?$.max.z-$.min.z:1,St=$.min.x,Bt=$.min.y,Yt=$.isBox3?$.min.z:0;else{let Qt=Math.pow(2,-H);bt=Math.floor(me.width*Qt),ct=Math.floor(me.height*Qt),E.isDataArrayTexture?xt=me.depth:E.isData3DTexture?xt=Math.floor(me.depth*Qt):xt=1,St=0,Bt=0,Yt=0}z!==null?(wt=z.x,Zt=z.y,Ce=z.z):(wt=0,Zt=0,Ce=0);let ue=st.convert(O.format),sn=st.convert(O.type),_t;O.isData3DTexture?(Ut.setTexture3D(O,0),_t=U.TEXTURE_3D):O.isDataArrayTexture||O.isCompressedArrayTexture?(Ut.setTexture2DArray(O,0),_t=U.TEXTURE_2D_ARRAY):(Ut.setTexture2D(O,0),_t=U.TEXTURE_2D),ft.activeTexture(U.TEXTURE0),ft.pixelStorei(U.UNPACK_FLIP_Y_WEBGL,O.flipY),ft.pixelStorei(U.UNPACK_PREMULTIPLY_ALPHA_WEBGL,O.premultiplyAlpha),ft.pixelStorei(U.UNPACK_ALIGNMENT,O.unpackAlignment);let fn=ft.getParameter(U.UNPACK_ROW_LENGTH),te=ft.getParameter(U.UNPACK_IMAGE_HEIGHT),os=ft.getParameter(U.UNPACK_SKIP_PIXELS),rn=ft.getParameter(U.UNPACK_SKIP_ROWS),Oo=ft.getParameter(U.UNPACK_SKIP_IMAGES);ft.pixelStorei(U.UNPACK_ROW_LENGTH,me.width),ft.pixelStorei(U.UNPACK_IMAGE_HEIGHT,me.height),ft.pixelStorei(U.UNPACK_SKIP_PIXELS,St),ft.pixelStorei(U.UNPACK_SKIP_ROWS,Bt),ft.pixelStorei(U.UNPACK_SKIP_IMAGES,Yt);let Di=E.isDataArrayTexture||E.isData3DTexture,as=O.isDataArrayTexture||O.isData3DTexture;if(E.isDepthTexture){let Qt=Rt.get(E),Ke=Rt.get(O),Xn=Rt.get(Qt.__renderTarget),_e=Rt.get(Ke.__renderTarget);ft.bindFramebuffer(U.READ_FRAMEBUFFER,Xn.__webglFramebuffer),ft.bindFramebuffer(U.DRAW_FRAMEBUFFER,_e.__webglFramebuffer);for(let Ge=0;Ge<xt;Ge++)Di&&(U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Rt.get(E).__webglTexture,H,Yt+Ge),U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Rt.get(O).__webglTexture,dt,Ce+Ge)),U.blitFramebuffer(St,Bt,St+bt,Bt+ct,wt,Zt,wt+bt,Zt+ct,U.DEPTH_BUFFER_BIT,U.NEAREST);ft.bindFramebuffer(U.READ_FRAMEBUFFER,null),ft.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else if(H!==0||E.isRenderTargetTexture||Rt.has(E)){let Qt=Rt.get(E),Ke=Rt.get(O);ft.bindFramebuffer(U.READ_FRAMEBUFFER,k),ft.bindFramebuffer(U.DRAW_FRAMEBUFFER,B);for(let Xn=0;Xn<xt;Xn++)Di?U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Qt.__webglTexture,H,Yt+Xn):U.framebufferTexture2D(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,Qt.__webglTexture,H),as?U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Ke.__webglTexture,dt,Ce+Xn):U.framebufferTexture2D(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,Ke.__webglTexture,dt),H!==0?U.blitFramebuffer(St,Bt,St+bt,Bt+ct,wt,Zt,wt+bt,Zt+ct,U.COLOR_BUFFER_BIT,U.NEAREST):as?U.copyTexSubImage3D(_t,dt,wt,Zt,Ce+Xn,St,Bt,bt,ct):U.copyTexSubImage2D(_t,dt,wt,Zt,St,Bt,bt,ct);ft.bindFramebuffer(U.READ_FRAMEBUFFER,null),ft.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else as?E.isDataTexture||E.isData3DTexture?U.texSubImage3D(_t,dt,wt,Zt,Ce,bt,ct,xt,ue,sn,me.data):O.isCompressedArrayTexture?U.compressedTexSubImage3D(_t,dt,wt,Zt,Ce,bt,ct,xt,ue,me.data):U.texSubImage3D(_t,dt,wt,Zt,Ce,bt,ct,xt,ue,sn,me):E.isDataTexture?U.texSubImage2D(U.TEXTURE_2D,dt,wt,Zt,bt,ct,ue,sn,me.data):E.isCompressedTexture?U.compressedTexSubImage2D(U.TEXTURE_2D,dt,wt,Zt,me.width,me.height,ue,me.data):U.texSubImage2D(U.TEXTURE_2D,dt,wt,Zt,bt,ct,ue,sn,me);ft.pixelStorei(U.UNPACK_ROW_LENGTH,fn),ft.pixelStorei(U.UNPACK_IMAGE_HEIGHT,te),ft.pixelStorei(U.UNPACK_SKIP_PIXELS,os),ft.pixelStorei(U.UNPACK_SKIP_ROWS,rn),ft.pixelStorei(U.UNPACK_SKIP_IMAGES,Oo),dt===0&&O.generateMipmaps===!0&&O.mipmapsAutoUpdate===!0&&U.generateMipmap(_t),ft.unbindTexture()},this.initRenderTarget=function(E){Rt.get(E).__webglFramebuffer===void 0&&Ut.setupRenderTarget(E)},this.initTexture=function(E){E.isCubeTexture?Ut.setTextureCube(E,0):E.isData3DTexture?Ut.setTexture3D(E,0):E.isDataArrayTexture||E.isCompressedArrayTexture?Ut.setTexture2DArray(E,0):Ut.setTexture2D(E,0),ft.unbindTexture()},this.resetState=function(){G=0,W=0,et=null,ft.reset(),ot.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Hn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=$t._getDrawingBufferColorSpace(t),e.unpackColorSpace=$t._getUnpackColorSpace()}};function go(i){let t=[];for(let s=0;s+2<i.length;s+=3)t.push([i[s],i[s+1],i[s+2]]);let e=[];for(let[s,r]of t.entries()){let o=e[e.length-1],a=t[s+1];o&&a&&(Zi(o,r)<5e-4||$S(o,a,r)<5e-4)||(o&&!a&&e.length>1&&Zi(o,r)<5e-4&&e.pop(),e.push(r))}let n=[0];for(let s=1;s<e.length;s++)n.push(n[s-1]+Zi(e[s-1],e[s]));return{points:e,along:e.length?n:[],length:n[n.length-1]}}function Zi(i,t){return Math.hypot(t[0]-i[0],t[1]-i[1],t[2]-i[2])}function $S(i,t,e){let n=[t[0]-i[0],t[1]-i[1],t[2]-i[2]],s=n[0]**2+n[1]**2+n[2]**2;if(s===0)return Zi(i,e);let r=[e[0]-i[0],e[1]-i[1],e[2]-i[2]],o=(r[0]*n[0]+r[1]*n[1]+r[2]*n[2])/s;return o<0||o>1?1/0:Math.hypot(r[0]-o*n[0],r[1]-o*n[1],r[2]-o*n[2])}function Nu(i,t){let{points:e,along:n}=i,s=1;for(;s<e.length-1&&n[s]<t;)s++;let r=e[s-1],o=e[s]??r,a=n[s]-n[s-1]||1,l=Math.min(1,Math.max(0,(t-n[s-1])/a)),c=[(o[0]-r[0])/a,(o[1]-r[1])/a,(o[2]-r[2])/a];return{point:[r[0]+l*(o[0]-r[0]),r[1]+l*(o[1]-r[1]),r[2]+l*(o[2]-r[2])],direction:c}}function Sm(i,t,e){if(t==="unknown"||i.points.length<2||i.length===0)return[];let n=[],s=t==="forward"?1:-1;for(let r=1,o=0;o===0||i.length/r>=e;r*=2,o++){let a=i.length/r;for(let l=0;l<r;l++){let{point:c,direction:h}=Nu(i,(l+.5)*a),u=o?a/2:a;n.push({point:c,direction:[s*h[0],s*h[1],s*h[2]],room:u})}if(o>=6)break}return n}function Mm(i){let t=[];for(let e=1;e<i.points.length;e++)t.push({from:i.points[e-1],to:i.points[e],start:i.along[e-1],end:i.along[e]});return t}var Du=`
uniform vec2 uViewport;
uniform float uScale;
uniform vec4 uPlane;
varying float vCut;
bool perspective() { return projectionMatrix[2][3] != 0.0; }
float depthOf(vec4 seen, float pull) {
  vec4 near = seen;
  if (perspective()) near.xyz += normalize(-seen.xyz) * min(pull, 0.4 * length(seen.xyz));
  else near.z += pull;
  vec4 clip = projectionMatrix * near;
  return clip.z / clip.w;
}
vec2 screenOf(vec4 clip) { return 0.5 * uViewport * clip.xy / clip.w; }
float pixelsPerMetre(vec4 seen) {
  float scale = 0.5 * uViewport.y * projectionMatrix[1][1];
  return perspective() ? scale / max(-seen.z, 1e-3) : scale;
}
`,Tm=`
attribute vec3 aFrom;
attribute vec3 aTo;
attribute vec3 aAlong;
attribute vec4 aColor;
attribute vec3 aLook;
uniform float uCasing;
uniform float uFaint;
varying vec2 vAt;
varying vec3 vSize;
varying vec4 vColor;
varying vec2 vDash;
${Du}
void main() {
  vec4 a = modelViewMatrix * vec4(aFrom, 1.0);
  vec4 b = modelViewMatrix * vec4(aTo, 1.0);
  vec2 along = aAlong.xy;
  if (perspective()) {
    // What is behind the eye is cut off at the near plane.
    float edge = projectionMatrix[3][2] / (projectionMatrix[2][2] - 1.0) * -1.001;
    if (a.z > edge && b.z > edge) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
    float t = clamp((edge - a.z) / (b.z - a.z), 0.0, 1.0);
    if (a.z > edge) { a = mix(a, b, t); along.x = mix(along.x, along.y, t); }
    else if (b.z > edge) { b = mix(a, b, t); along.y = mix(along.x, along.y, t); }
  }
  vec4 ca = projectionMatrix * a;
  vec4 cb = projectionMatrix * b;
  vec2 sa = screenOf(ca);
  vec2 sb = screenOf(cb);
  vec2 way = sb - sa;
  float length_ = length(way);
  vec2 dir = length_ > 1e-3 ? way / length_ : vec2(1.0, 0.0);
  // From afar lines are thinner, so that the plant is still seen; what is marked or selected isn't.
  float metre = 0.5 * (pixelsPerMetre(a) + pixelsPerMetre(b));
  float bore = max(aAlong.z - 0.06, 0.03) / 0.75;
  float thin = aLook.z > 1.5 ? 1.0 : clamp(0.35 + bore * metre / (6.0 * uScale), 0.5, 1.0);
  float core = 0.5 * aLook.x * thin * uScale;
  float casing = uCasing * thin * uScale;
  float reach = core + casing + 1.0;
  float cap = uFaint > 0.0 ? 0.0 : reach;
  float side = position.y;
  float end = position.x;
  vec2 at = mix(sa, sb, end) + dir * (2.0 * end - 1.0) * cap + vec2(-dir.y, dir.x) * side * reach;
  vAt = vec2(mix(-cap, length_ + cap, end), side * reach);
  vSize = vec3(core, casing, length_);
  vColor = aColor;
  // Dashes keep their place on the pipe; their length doubles or halves with the distance so that they stay readable.
  float period = exp2(floor(log2(20.0 * uScale / metre) + 0.5));
  float perPixel = length_ > 1e-3 ? (along.y - along.x) / length_ : 0.0;
  float from = along.x - cap * perPixel;
  float to = along.y + cap * perPixel;
  vDash = vec2(mix(from, to, end) / period, aLook.y);
  float depth = depthOf(mix(a, b, end), aAlong.z);
  vCut = dot(uPlane, mix(a, b, end));
  gl_Position = vec4(at / (0.5 * uViewport), depth, 1.0);
  if (aColor.a <= 0.0 || (uFaint > 0.0 && aLook.z < 0.0)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  vSize.y *= aLook.z < 0.0 ? 0.0 : 1.0;
}
`,Em=`
uniform vec3 uCasingColor;
uniform float uFaint;
uniform float uTime;
varying vec2 vAt;
varying vec3 vSize;
varying vec4 vColor;
varying vec2 vDash;
varying float vCut;
void main() {
  if (vCut > 0.0) discard;
  float off = length(vec2(vAt.x - clamp(vAt.x, 0.0, vSize.z), vAt.y));
  float core = vSize.x;
  float casing = vSize.y;
  float inCore = 1.0 - smoothstep(core - 0.5, core + 0.5, off);
  float inAll = 1.0 - smoothstep(core + casing - 0.5, core + casing + 0.5, off);
  if (vDash.y > 0.5 && vDash.y < 1.5) {
    float gap = abs(fract(vDash.x) - 0.5) * 2.0;
    inCore *= 1.0 - smoothstep(0.56, 0.62, gap);
  }
  vec3 color = vColor.rgb;
  if (uTime >= 0.0 && vDash.y > 1.5) {
    float wave = fract(vDash.x * 0.5 - uTime);
    color = mix(color, uCasingColor, 0.55 * smoothstep(0.75, 0.9, wave) * (1.0 - smoothstep(0.9, 1.0, wave)));
  }
  float alpha = uFaint > 0.0 ? inCore * uFaint * vColor.a : inAll * vColor.a;
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(uFaint > 0.0 ? color : mix(uCasingColor, color, inCore), alpha);
  #include <colorspace_fragment>
}
`,Am=`
attribute vec3 aAt;
attribute vec3 aDirection;
attribute vec3 aRoom;
attribute vec3 aColor;
varying vec3 vColor;
varying vec3 vEdge;
varying float vHeight;
${Du}
void main() {
  vec4 seen = modelViewMatrix * vec4(aAt, 1.0);
  vec3 toward = (modelViewMatrix * vec4(aDirection, 0.0)).xyz;
  vec4 clip = projectionMatrix * seen;
  float metre = pixelsPerMetre(seen);
  // How long a metre of the pipe appears: seen from its end an arrow says nothing.
  vec4 beside = projectionMatrix * vec4(seen.xyz + toward * (10.0 / metre), 1.0);
  vec2 way = screenOf(beside) - screenOf(clip);
  float share = min(1.0, length(way) / 10.0);
  float room = aRoom.x * metre * share;
  float fit = aRoom.z * smoothstep(30.0 * uScale, 44.0 * uScale, room) * smoothstep(0.2, 0.35, share);
  vec2 dir = length(way) > 1e-4 ? normalize(way) : vec2(1.0, 0.0);
  float size = (5.5 + 1.2 * aRoom.z) * uScale * fit;
  vec2 at = screenOf(clip) + size * (dir * position.x + vec2(-dir.y, dir.x) * position.y);
  vEdge = vec3(float(gl_VertexID == 0), float(gl_VertexID == 1), float(gl_VertexID == 2));
  vHeight = 2.6 * size;
  vCut = dot(uPlane, seen);
  vColor = aColor;
  bool behind = perspective() && seen.z > -1e-3;
  gl_Position = fit <= 0.01 || behind
    ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(at / (0.5 * uViewport), depthOf(seen, aRoom.y), 1.0);
}
`,Cm=`
uniform vec3 uCasingColor;
uniform float uScale;
uniform float uFaint;
varying vec3 vColor;
varying vec3 vEdge;
varying float vHeight;
varying float vCut;
void main() {
  if (vCut > 0.0) discard;
  float edge = min(vEdge.x, min(vEdge.y, vEdge.z)) * vHeight;
  float rim = 1.3 * uScale;
  float core = smoothstep(rim - 0.5, rim + 0.5, edge);
  float alpha = uFaint > 0.0 ? uFaint * core : smoothstep(0.0, 1.0, edge);
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(mix(uCasingColor, vColor, core), alpha);
  #include <colorspace_fragment>
}
`,Pm=`
attribute vec3 aColor;
attribute vec3 aDot;
varying vec3 vColor;
varying float vForm;
varying float vSide;
${Du}
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vec4 clip = projectionMatrix * seen;
  float metre = pixelsPerMetre(seen);
  // Small things of the network (ports) come when there is room for them.
  float fit = aDot.y < 6.0 ? smoothstep(110.0 * uScale, 180.0 * uScale, metre) : 1.0;
  if (aDot.y > 6.0 && aDot.y < 14.0) fit = clamp(0.45 + metre / (90.0 * uScale), 0.55, 1.0);
  vColor = aColor;
  vForm = aDot.x;
  vSide = (aDot.y + 3.0) * uScale * fit;
  vCut = dot(uPlane, seen);
  gl_PointSize = vSide;
  bool behind = perspective() && seen.z > -1e-3;
  gl_Position = fit <= 0.01 || aDot.y <= 0.0 || behind
    ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(clip.xy / clip.w, depthOf(seen, aDot.z), 1.0);
}
`,Rm=`
uniform vec3 uCasingColor;
uniform float uScale;
uniform float uFaint;
varying vec3 vColor;
varying float vForm;
varying float vSide;
varying float vCut;
void main() {
  if (vCut > 0.0) discard;
  vec2 p = (gl_PointCoord - 0.5) * vSide;
  float radius = 0.5 * vSide - 1.5 * uScale;
  float round_ = length(p) - radius;
  float square = max(abs(p.x), abs(p.y)) - 0.86 * radius;
  float shape = vForm < 1.5 ? round_ : square;
  float inside = 1.0 - smoothstep(-0.5, 0.5, shape);
  float all = 1.0 - smoothstep(-0.5, 0.5, shape - 1.2 * uScale);
  if (vForm > 0.5 && vForm < 1.5) inside *= smoothstep(-0.5, 0.5, length(p) - radius + 2.4 * uScale);
  if (vForm > 1.5 && vForm < 2.5) inside *= smoothstep(-0.5, 0.5, abs(abs(p.x) - 0.43 * radius) - 0.6 * uScale);
  float alpha = uFaint > 0.0 ? inside * uFaint : all;
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(mix(uCasingColor, vColor, inside), alpha);
  #include <colorspace_fragment>
}
`;var XS=.3,qS=.35,YS=.06,ZS=.02,Wl=class{front=new ai;through=new ai;uniforms={uViewport:{value:new Et(1,1)},uScale:{value:1},uTime:{value:-1},uCasing:{value:1.4},uCasingColor:{value:new Ot(1,1,1)},uPlane:{value:new Wt(0,0,0,-1)}};ribbons=new Zs;arrows=new Zs;dots=new Le;owners=[];plane=new Wt(0,0,0,-1);arrowRows=[];dotPlaces=[];constructor(t){QS(this.ribbons),tM(this.arrows);let e=[[this.ribbons,Tm,Em],[this.arrows,Am,Cm],[this.dots,Pm,Rm]];for(let[n,s]of[[this.through,XS],[this.front,0]])e.forEach(([r,o,a],l)=>{let c=this.material(o,a,s),h=r===this.dots?new Xr(r,c):new Ie(r,c);h.frustumCulled=!1,h.renderOrder=10+l,h.raycast=()=>{},h.onBeforeRender=(u,d,f)=>this.fit(u,f,t(),c),n.add(h)})}setPlan(t){this.layRibbons(t),this.layArrows(t),this.layDots(t)}setStrokes(t,e,n){this.uniforms.uCasingColor.value.setRGB(...n.casing,"srgb");let s=this.ribbons.getAttribute("aColor"),r=this.ribbons.getAttribute("aLook");this.owners.forEach(({row:h,lead:u},d)=>{let f=t[h];s.setXYZW(d,...Ou(f.color),f.shown?u?.9:1:0);let p=f.dashed?1:f.arrows?2:0;r.setXYZ(d,u?.5*f.width:f.width,u?0:p,f.strong?2:u||f.dim?-1:1)});let o=this.arrows.getAttribute("aColor"),a=this.arrows.getAttribute("aRoom");this.arrowRows.forEach((h,u)=>{let d=t[h];o.setXYZ(u,...Ou(d.color)),a.setZ(u,d.shown&&d.arrows?d.strong?1.3:1:0)});let l=this.dots.getAttribute("aColor"),c=this.dots.getAttribute("aDot");this.dotPlaces.forEach((h,u)=>{let d=e(h,c.getX(u)===3);l.setXYZ(u,...Ou(d.color)),c.setY(u,d.size)});for(let h of[s,r,o,a,l,c])h.needsUpdate=!0}setSection(t){let e=t?.flipped?-1:1;this.plane.set(0,0,0,t?-e*t.at:-1),t&&this.plane.setComponent("xyz".indexOf(t.axis),e)}setTime(t){this.uniforms.uTime.value=t}set visible(t){this.front.visible=t,this.through.visible=t}layRibbons(t){let e=[],n=[],s=[];this.owners=[];let r=(a,l,c,h,u,d)=>{e.push(...a),n.push(...l),s.push(c,h,u),this.owners.push(d)};t.content.network.connections.forEach((a,l)=>{let c=go(a.path),h=Hl(a.diameter),u=a.flow==="backward";for(let d of Mm(c))u?r(d.to,d.from,c.length-d.end,c.length-d.start,h,{row:l,lead:!1}):r(d.from,d.to,d.start,d.end,h,{row:l,lead:!1});for(let[d,f]of[[a.source,c.points[0]],[a.target,c.points.at(-1)]]){let p=t.places.get(d);!f||!p?.unit||Zi(f,p.point)<ZS||r(f,p.point,0,1,h,{row:l,lead:!0})}});let o=this.owners.length;Lm(this.ribbons,o,{aFrom:[e,3],aTo:[n,3],aAlong:[s,3],aColor:[null,4],aLook:[null,3]})}layArrows(t){let e=[],n=[],s=[];this.arrowRows=[],t.content.network.connections.forEach((r,o)=>{for(let a of Sm(go(r.path),r.flow,qS))e.push(...a.point),n.push(...a.direction),s.push(a.room,Hl(r.diameter),1),this.arrowRows.push(o)}),Lm(this.arrows,this.arrowRows.length,{aAt:[e,3],aDirection:[n,3],aRoom:[s,3],aColor:[null,3]})}layDots(t){let e=[],n=[];this.dotPlaces=[];let s={junction:0,open:1,blind:2,unknown:1};for(let r of t.places.values()){let o=Hl(jS(t,r.connections));r.unit||(e.push(...r.point),n.push(s[r.type]??0,1,o),this.dotPlaces.push(r.id));for(let a of r.unit?.ports??[])e.push(...a.point),n.push(3,1,Hl(a.diameter)),this.dotPlaces.push(r.id)}this.dots.dispose(),this.dots.setAttribute("position",new $e(e,3)),this.dots.setAttribute("aDot",new $e(n,3)),this.dots.setAttribute("aColor",new $e(new Float32Array(e.length),3))}material(t,e,n){return new hn({vertexShader:t,fragmentShader:e,uniforms:{...this.uniforms,uFaint:{value:n}},transparent:!0,depthTest:n===0,depthWrite:!1,toneMapped:!1,side:Oe})}fit(t,e,n,s){let r=t.getCurrentViewport(JS);this.uniforms.uViewport.value.set(r.z,r.w),this.uniforms.uScale.value=n>0?r.w/n:1,this.uniforms.uPlane.value.copy(this.plane).applyMatrix4(KS.copy(e.matrixWorld).transpose()),s.uniformsNeedUpdate=!0}},JS=new Wt,KS=new Mt;function Hl(i){return .75*(i??.05)+YS}function jS(i,t){let e=t.map(n=>i.content.network.connections[n].diameter??0);return e.length?Math.max(...e):null}var Gl=new Ot;function Ou(i){return Gl.setRGB(...i,"srgb"),[Gl.r,Gl.g,Gl.b]}function QS(i){i.setAttribute("position",new $e([0,-1,0,1,-1,0,1,1,0,0,1,0],3)),i.setIndex([0,1,2,0,2,3]),i.instanceCount=0}function tM(i){i.setAttribute("position",new $e([1.5,0,0,-1.1,1.25,0,-1.1,-1.25,0],3)),i.instanceCount=0}function Lm(i,t,e){i.dispose();for(let[n,[s,r]]of Object.entries(e)){let o=s?new Float32Array(s):new Float32Array(t*r),a=new Gr(o,r);s||a.setUsage(xu),i.setAttribute(n,a)}i.instanceCount=t}function Fu(i,t){let e={width:Math.max(1,t.width-24),height:Math.max(1,t.height-24)},n=Math.min(e.width/i.width,e.height/i.height,3);return{zoom:n,x:(t.width-n*i.width)/2,y:(t.height-n*i.height)/2}}function km(i,t){let e=Fu(i,t),n=Math.min(1,(t.width-24)/i.width);return e.zoom>=.45||n<=e.zoom?e:{zoom:n,x:(t.width-n*i.width)/2,y:0}}function Uu(i,t,e,n,s){let r=Math.min(12,Math.max(s,i.zoom*t)),o=r/i.zoom;return{zoom:r,x:e-o*(e-i.x),y:n-o*(n-i.y)}}function Nm(i,t,e,n,s){let r=i.x+i.zoom*t.x,o=i.y+i.zoom*t.y,a=r+i.zoom*t.width,l=o+i.zoom*t.height,c=r>=12&&o>=12&&a<=n.width-12&&l<=n.height-12;if(!s&&c&&i.zoom>.45)return i;let h=Math.min(.8*n.width/Math.max(t.width,1),.8*n.height/Math.max(t.height,1)),u=Math.min(h,s?Math.max(i.zoom,1.6):Math.max(i.zoom,.9));return{zoom:u,x:Im(n.width/2-u*(t.x+t.width/2),u*e.width,n.width),y:Im(n.height/2-u*(t.y+t.height/2),u*e.height,n.height)}}function Im(i,t,e){return t<=e?(e-t)/2:Math.min(0,Math.max(e-t,i))}function Dm(i,t){let e=i.getAttribute("data-connection");if(e!==null)return e.split(" ").map(Number);let n=i.getAttribute("data-line");return n===null?[]:t.content.network.lines.find(s=>s.tag===n)?.connections??[]}function Om(i,t){let e=i.filter(n=>t.has(n)).length;return e===0?"none":e===i.length?"all":"partly"}var Bm="http://www.w3.org/2000/svg",Vu=String.raw`[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?`,Be=new RegExp(`^${Vu}%?$`,"i"),Bu=new RegExp(`^\\s*(?:${Vu}[\\s,]*)*$`,"i"),eM=/^[MLHVCSQTAZmlhvcsqtaz\d\s,.eE+-]*$/,nM=new RegExp(`^\\s*(?:(?:translate|rotate|scale)\\(\\s*(?:${Vu}[\\s,]*)+\\)\\s*)*$`,"i"),iM=/^[a-z][a-z0-9 _-]*$/i,Fm=/^[^]*$/,Um={class:iM,transform:nM,"data-id":Fm,"data-line":Fm,"data-connection":/^\d+( \d+)*$/},zu={svg:{width:Be,height:Be,viewBox:Bu},g:{},title:{},path:{d:eM},circle:{cx:Be,cy:Be,r:Be},rect:{x:Be,y:Be,width:Be,height:Be,rx:Be},polygon:{points:Bu},polyline:{points:Bu},line:{x1:Be,y1:Be,x2:Be,y2:Be},text:{x:Be,y:Be,"font-size":Be},tspan:{x:Be,y:Be}},sM=new Set(["text","tspan","title"]),rM=40;function oM(i,t,e){let n=Object.hasOwn(zu,i)?zu[i]:null;if(!n)return!1;let s=Object.hasOwn(n,t)?n[t]:Object.hasOwn(Um,t)?Um[t]:null;return s!==null&&s.test(e)}function zm(i,t,e=0){let n=i.localName??"";if(i.nodeType!==1||i.namespaceURI!==Bm||!Object.hasOwn(zu,n)||e>rM)return null;let s=t.element(n);for(let{name:r,value:o}of Array.from(i.attributes??[]))oM(n,r,o)&&t.attribute(s,r,o);for(let r of Array.from(i.childNodes))if(r.nodeType===1){let o=zm(r,t,e+1);o!==null&&t.append(s,o)}else r.nodeType===3&&sM.has(n)&&t.append(s,r.nodeValue??"");return s}var aM={element:i=>document.createElementNS(Bm,i),attribute:(i,t,e)=>i.setAttribute(t,e),append:(i,t)=>i.append(t)};function Vm(i){let t=new DOMParser().parseFromString(i,"image/svg+xml").documentElement;return t.localName!=="svg"?null:zm(t,aM)}var lM=250,cM=4,$l=class{sheet=se("g",{});halos=se("g",{class:"net-halos"});drawn=se("g",{});canvas;note=y("p",{class:"net-empty",role:"status"},"Drawing the schematic\u2026");partly=y("p",{class:"net-sheet-partly",hidden:!0,"data-test":"sheet-partly"},y("span",{class:"net-stroke is-partly","aria-hidden":"true"}),"partly in it: what of it, the plant shows");frame=null;size={width:1,height:1};elements=new Map;pieces=[];version=-1;timer=0;asked=0;touched=!1;lastShown="";store;source;focus;planNow;actions;constructor(t,e,n,s,r,o){this.store=e,this.source=n,this.focus=s,this.planNow=r,this.actions=o,this.sheet.append(this.halos,this.drawn),this.canvas=se("svg",{class:"net-sheet",role:"img","aria-label":"Schematic of the plant"},this.sheet),t.classList.add("net-schematic"),t.append(this.toolbar(),this.canvas,this.partly,this.note),this.listen(),new ResizeObserver(()=>this.resized()).observe(this.canvas)}refresh(){if(!this.store.shown.schematic)return;(this.store.content?.version??-1)!==this.version&&(clearTimeout(this.timer),this.timer=window.setTimeout(()=>{this.load()},this.version<0?0:lM)),this.light()}fit(){let t=this.sheetSize();t&&(this.touched=!0,this.look(Fu(t,this.size)))}open(){let t=this.sheetSize();t&&this.look(km(t,this.size))}zoom(t){this.touched=!0,this.frame&&this.look(Uu(this.frame,t,this.size.width/2,this.size.height/2,.05))}toSelection(){this.show(this.selected(),!0)}async load(){let t=this.store.content?.version??-1,e=++this.asked,n;try{n=await this.source.schematic()}catch(r){e===this.asked&&this.tell(r instanceof Error?r.message:"The schematic could not be fetched.");return}if(e!==this.asked)return;this.version=t;let s=Vm(n);if(!s){this.tell("The schematic could not be read.");return}this.tell(""),this.adopt(s)}adopt(t){t.classList.add("schematic");for(let n of[...t.children])n.localName==="title"&&n.remove();for(let n of t.querySelectorAll("path[data-line]"))hM(n);this.drawn.replaceChildren(t),this.elements.clear();let e=this.planNow();this.pieces=[];for(let n of t.querySelectorAll("[data-id],[data-line],[data-connection]")){let s=n.getAttribute("data-id");if(s!==null)this.keep(`place ${s}`,n);else{let r=Dm(n,e);this.pieces.push({element:n,rows:r});for(let o of r)this.keep(`connection ${o}`,n)}}this.measure()&&(!this.frame||!this.touched)&&this.open(),this.lastShown="",this.light()}keep(t,e){let n=this.elements.get(t);n?n.push(e):this.elements.set(t,[e])}light(){let{marks:t}=this.store.shown,e=this.selected(),n=new Set;this.focus.hoveredPlace&&n.add(`place ${this.focus.hoveredPlace}`);for(let o of this.focus.hoveredConnections)n.add(`connection ${o}`);let s=new Set([...t?.places??[]].map(o=>`place ${o}`));this.drawn.classList.toggle("has-marks",t!==null);for(let[o,a]of this.elements){if(!o.startsWith("place "))continue;let l=t?.close.has(o.slice(6))??!1;for(let{classList:c}of a)c.toggle("is-selected",e.has(o)),c.toggle("is-hovered",n.has(o)),c.toggle("is-marked",s.has(o)),c.toggle("is-close",l)}let r=!1;for(let{element:{classList:o},rows:a}of this.pieces){let l=t?Om(a,t.connections):"none";o.toggle("is-selected",a.some(c=>e.has(`connection ${c}`))),o.toggle("is-hovered",a.some(c=>n.has(`connection ${c}`))),o.toggle("is-marked",l==="all"),o.toggle("is-partly",l==="partly"),r||=l==="partly"&&o.contains("p")}this.partly.hidden=!r,this.drawHalos(e,t?[...t.close].map(o=>`place ${o}`):[]),this.follow(e)}drawHalos(t,e){let n=[],s=(r,o)=>{let a=r.startsWith("place ")?this.boxOf(new Set([r])):null;a&&n.push(se("rect",{class:o,x:String(a.x-4),y:String(a.y-4),width:String(a.width+8),height:String(a.height+8),rx:"5"}))};e.forEach(r=>s(r,"is-close")),t.forEach(r=>s(r,"is-selected")),this.halos.replaceChildren(...n)}follow(t){let e=[...t].sort().join(`
`);e===this.lastShown||!this.elements.size||(this.lastShown=e,this.show(t,!1))}show(t,e){let n=this.boxOf(t),s=this.sheetSize();if(!n||!s||!this.frame||!this.measure())return;let r=Nm(this.frame,n,s,this.size,e);r!==this.frame&&(this.touched=!0,this.look(r))}selected(){let t=new Set,{place:e}=this.focus;e&&t.add(`place ${e.id}`);for(let n of this.focus.connections)t.add(`connection ${n}`);return t}boxOf(t){let[e,n,s,r]=[1/0,1/0,-1/0,-1/0];for(let o of t)for(let a of this.elements.get(o)??[]){let l=a.getBBox(),c=uM(a,this.drawn);for(let[h,u]of[[l.x,l.y],[l.x+l.width,l.y+l.height]]){let d=new DOMPoint(h,u).matrixTransform(c);[e,s]=[Math.min(e,d.x),Math.max(s,d.x)],[n,r]=[Math.min(n,d.y),Math.max(r,d.y)]}}return e>s?null:{x:e,y:n,width:s-e,height:r-n}}look(t){this.frame=t,this.sheet.setAttribute("transform",`translate(${t.x} ${t.y}) scale(${t.zoom})`)}sheetSize(){let t=this.drawn.firstElementChild,e=Number(t?.getAttribute("width")),n=Number(t?.getAttribute("height"));return e>0&&n>0?{width:e,height:n}:null}resized(){this.measure()&&!this.touched&&this.open()}measure(){let{clientWidth:t,clientHeight:e}=this.canvas;return!t||!e?!1:(this.size={width:t,height:e},!0)}tell(t){this.note.textContent=t,this.note.hidden=t===""}toolbar(){let t=(e,n,s,r)=>y("button",{type:"button","data-test":e,title:s,"aria-label":s,onclick:r},n);return y("div",{class:"net-sheet-tools",role:"toolbar","aria-label":"Schematic"},t("sheet-out","\u2212","Smaller",()=>this.zoom(1/1.4)),t("sheet-in","+","Larger",()=>this.zoom(1.4)),t("sheet-fit","Fit","Show the whole schematic",()=>this.fit()),t("sheet-selection","To selection","Show what is selected",()=>this.toSelection()))}listen(){let{canvas:t}=this;t.addEventListener("wheel",n=>{if(n.preventDefault(),!this.frame)return;let s=t.getBoundingClientRect(),r=n.deltaMode===1?30*n.deltaY:n.deltaY;this.touched=!0,this.look(Uu(this.frame,Math.exp(-r*.0016),n.clientX-s.left,n.clientY-s.top,.05))},{passive:!1});let e=null;t.addEventListener("pointerdown",n=>{this.frame&&n.button<=1&&(e={x:n.clientX,y:n.clientY,frame:this.frame,moved:!1})}),t.addEventListener("pointermove",n=>{if(!e){this.hover(n.target);return}let[s,r]=[n.clientX-e.x,n.clientY-e.y];!e.moved&&Math.hypot(s,r)<cM||(e.moved||t.setPointerCapture(n.pointerId),e.moved=!0,this.touched=!0,this.look({...e.frame,x:e.frame.x+s,y:e.frame.y+r}))}),t.addEventListener("pointerup",n=>{e&&!e.moved&&this.click(n.target),e=null}),t.addEventListener("pointercancel",()=>e=null),t.addEventListener("pointerleave",()=>this.hover(null)),t.addEventListener("dblclick",()=>this.toSelection())}click(t){let e=this.under(t);e?.id!==void 0?this.actions.place(e.id):e&&e.line>=0?this.actions.line(e.line):this.store.select([])}hover(t){let e=this.under(t);this.focus.hoverLine(e&&e.id===void 0?e.line:-1);let n=e?.id===void 0?void 0:this.planNow().places.get(e.id)?.parts[0];(n??-1)!==this.store.shown.hovered&&this.store.set({hovered:n??-1})}under(t){let e=t?.closest("[data-id],[data-line]");if(!e||!this.drawn.contains(e)||this.version!==this.store.content?.version)return null;let n=this.planNow(),s=e.getAttribute("data-id");if(s!==null)return n.places.has(s)?{id:s,line:-1}:null;let r=e.getAttribute("data-line");return{line:n.content.network.lines.findIndex(o=>o.tag===r)}}};function hM(i){let t=se("path",{class:"net-hit"});for(let e of["d","data-line","data-connection"]){let n=i.getAttribute(e);n!==null&&t.setAttribute(e,n)}i.parentElement?.prepend(t)}function uM(i,t){let e=new DOMMatrix;for(let n=i;n&&n!==t;n=n.parentElement){let s=n.transform?.baseVal.consolidate()?.matrix;s&&(e=new DOMMatrix([s.a,s.b,s.c,s.d,s.e,s.f]).multiply(e))}return e}function vs(i){return i.flow==="unknown"?"unknown":i.confidence!==null&&i.confidence<.7?"doubtful":"known"}function Gm(i){return i==="forward"?"backward":i==="backward"?"forward":"unknown"}function Wm(i){let{source_name:t,target_name:e,flow:n}=i;return n==="unknown"?`${t} \u2013 ${e}`:n==="forward"?`${t} \u2192 ${e}`:`${e} \u2192 ${t}`}function Li(i){return i===null?"length unknown":i<1?`${Math.round(i*1e3)} mm`:`${i<100?i.toFixed(2):Math.round(i)} m`}function Hu(i){return i.size!==null?`DN ${i.size}`:i.diameter===null?"size unknown":`\u2300 ${Li(i.diameter)}`}function ys(i){return/^\d/.test(i)?`DN ${i}`:i}function Gu(i){return i===null?"unknown":`${Math.round(100*i)} %`}var Hm="set by a user: ",dM={open:"open end",blind:"blind end",unknown:"end"};function Wu({source:i,target:t,reason:e},n){if(!e?.startsWith(Hm))return!1;let s=[i,t].map(r=>{let o=n.places.get(r);return o?dM[o.type]??o.name:r});return[s,[...s].reverse()].some(r=>e===`${Hm}${r.join(" -> ")}`)}var xo=.1,qm={missing:"Units that lack a line",joint:"Faces that may be joined",open:"Open ends"};function Xl(i,t=Pr(i)){let e=[...fM(t),...pM(t),...mM(t)],n=["missing","joint","open"];return e.sort((s,r)=>n.indexOf(s.kind)-n.indexOf(r.kind))}function fM(i){return i.content.network.units.filter(e=>e.missing>0).map(e=>({key:`missing:${e.id}`,kind:"missing",title:`${e.tag} lacks ${Xm(e.missing,"line")}`,text:`A ${e.kind??e.type} needs ${Xm(e.missing,"more line","more lines")} than was found here. A part beside it may have a wrong label, or pipes end in a gap. Until then tracing and isolating stop here.`,place:e.id,parts:e.parts,point:e.point}))}function pM(i){let t=i.content.network.joints.filter(e=>!e.made&&e.score>=xo);return t.sort((e,n)=>n.score-e.score),t.map(e=>({key:`joint:${i.content.parts.id[e.first]}:${i.content.parts.id[e.second]}`,kind:"joint",title:`${$m(i,e.first)} and ${$m(i,e.second)} may be joined`,text:`Likelihood ${Math.round(100*e.score)} %: ${xM(e)}. It was not taken for a joint.`,place:null,parts:[e.first,e.second],point:e.point}))}function mM(i){return[...i.places.values()].filter(e=>e.type==="open"||e.type==="unknown").map(e=>({key:`open:${e.id}`,kind:"open",title:`${e.type==="open"?"Open end":"Pipe ends"}${gM(i,e)}`,text:e.type==="open"?"The pipe ends here without a flange or cap that closes it: where the model ends, or where a piece is missing.":"The pipe ends here, and it can't be told whether it is closed.",place:e.id,parts:[...e.parts],point:e.point}))}function gM(i,t){let e=t.connections[0];if(e===void 0)return"";let n=i.content.network.connections[e],s=n.size===null?"":`, DN ${n.size}`;return` beside ${Vo(n,t.id).name}${s}`}function $m(i,t){let e=i.placeOfPart.get(t),n=e===void 0?void 0:i.places.get(e);return n?n.name:i.content.parts.name[t]??i.content.groups[i.content.parts.group[t]]?.name??"a part"}function xM(i){return i.reasons.length?i.reasons.join("; "):`a gap of ${(1e3*i.gap).toFixed(1)} mm`}function Xm(i,t,e=`${t}s`){return i===1?`one ${t}`:`${i} ${e}`}var $u=12;function Jm(i){let{asking:t,focus:e}=i,n=[];t.busy&&n.push(y("p",{class:"net-soft",role:"status"},"Following the pipes\u2026")),t.refusal&&n.push(y("p",{class:"net-refusal",role:"alert"},t.refusal)),t.answer&&n.push(Af(t.answer,i));let{place:s}=e;e.selectedLine>=0?n.push(wM(i,e.selectedLine)):s?n.push(vM(i,s)):n.push(...[...e.connections].slice(0,3).map(o=>bM(i,o)));let r=MM(i);return r&&n.push(r),n}function vM(i,t){let e=t.connections,n=y("ul",{class:"net-connections"},...e.slice(0,$u).map(s=>{let r=i.plan.content.network.connections[s],o=Vo(r,t.id);return y("li",{},y("span",{class:"net-arrow",title:EM(r,t.id)},Qm(r,t.id)),Oi(o.id,o.name,i),y("span",{class:"net-soft"},`${Hu(r)}, ${Li(r.length)}`))}));return y("section",{class:"net-card","data-test":"net-place","aria-label":"On the network"},y("h3",{},"On the network"),e.length?n:y("p",{class:"net-soft"},"No pipe was found that leads here."),e.length>$u?y("p",{class:"net-soft"},`and ${e.length-$u} more`):null,e.length&&i.live?yM(i,t):null,e.length&&!i.live?y("p",{class:"net-soft"},"Tracing and isolating need 'cadgraph view'."):null)}function yM({asking:i},t){let e=i.picking===t.id,n=(s,r,o,a,l)=>y("button",{type:"button","data-test":s,title:o,disabled:i.busy,onclick:a,"aria-pressed":l===void 0?void 0:String(l)},r);return y("div",{},y("div",{class:"net-buttons"},n("net-upstream","Upstream","Trace what leads here (Shift+Up)",()=>{i.trace(t.id,"upstream")}),n("net-downstream","Downstream","Trace where it leads (Shift+Down)",()=>{i.trace(t.id,"downstream")}),n("net-trace-to","Way to\u2026","Trace the way to a second one (Shift+Right)",()=>i.startPick(t.id),e),t.unit&&n("net-isolate","Valves to close","Isolate: which valves must be closed to cut it off (v)",()=>{i.isolate(t.id)})),e?y("p",{class:"net-verdict",role:"status"},`Click where the way from ${t.name} should lead.`):null)}function bM(i,t){let{plan:e,editable:n}=i,s=e.content.network.connections[t],r=e.content.network.lines[s.line];return y("section",{class:"net-card","data-test":"net-connection","aria-label":"Connection"},y("h3",{},"Connection ",Oi(s.source,s.source_name,i)," \u2013 ",Oi(s.target,s.target_name,i)),y("p",{class:"net-soft"},`${Hu(s)}, ${Li(s.length)}`),r?_M(i,s.line,r):null,SM(s),n?Km(s.flow,s.source_name,s.target_name,Wu(s,e),o=>i.panels.edit([jm(i,s,o)])):null)}function wM(i,t){let{plan:e,editable:n}=i,s=e.content.network.lines[t],r=_f(e,s),o=r.map(f=>e.content.network.connections[f.row]),a=o.filter(f=>vs(f)!=="known").length,l=e.places.get(s.start)?.name??s.start,c=e.places.get(s.end)?.name??s.end,h=o.map(f=>Wu(f,e)),u=f=>r.flatMap(({along:p},b)=>f==="unknown"&&!h[b]?[]:[jm(i,o[b],p?f:Gm(f))]),d={forward:`Flows from ${l} to ${c}`,backward:`Flows from ${c} to ${l}`,unknown:"Direction of flow unknown",none:"No flow: it ends at a closed end",contradictory:"The directions found along it contradict each other"};return y("section",{class:"net-card","data-test":"net-line-card","aria-label":`Line ${s.tag}`},y("h3",{},`Line ${s.tag}`),y("p",{class:"net-soft"},`${ys(s.size)}, ${Li(s.length)}, ${wn(o.length,"piece")}`),y("p",{},Oi(s.start,l,i)," \u2013 ",Oi(s.end,c,i)),y("p",{},d[s.flow]??`Flow: ${s.flow}`,Ym(o)?y("span",{class:"net-soft"},`: ${Ym(o)}`):null),a?y("p",{class:"net-verdict is-unsure"},`Not certain in ${a} of ${wn(o.length,"piece")}.`):null,n?Km(s.flow,l,c,h.includes(!0),f=>i.panels.edit(u(f))):null)}function Ym(i){return i.find(t=>t.reason!==null)?.reason??null}function _M(i,t,e){return y("p",{},"Line ",y("button",{type:"button",class:"net-link",onclick:()=>i.focus.selectLine(t),onpointerenter:()=>i.focus.hoverLine(t),onpointerleave:()=>i.focus.hoverLine(-1)},e.tag))}function SM(i){if(i.flow==="unknown")return y("p",{class:"net-verdict is-unsure"},"Direction of flow unknown: tracing halts here.");let t=vs(i);return y("p",{class:t==="doubtful"?"net-verdict is-unsure":""},`Flows ${Wm(i)}`,i.reason?`: ${i.reason}`:"",y("span",{class:"net-soft"},`, ${t==="doubtful"?"not certain: ":""}likelihood ${Gu(i.confidence)}`))}function Km(i,t,e,n,s){let r=(o,a,l)=>y("button",{type:"button","data-test":`net-flow-${o}`,title:l,"aria-pressed":o==="unknown"?void 0:String(i===o),onclick:()=>{s(o)}},a);return y("div",{class:"net-buttons",role:"group","aria-label":"Direction of flow"},r("forward",`${t} \u2192 ${e}`,`Set: flows from ${t} to ${e}`),r("backward",`${e} \u2192 ${t}`,`Set: flows from ${e} to ${t}`),n&&r("unknown","Take back","Takes a direction back that was set by hand"))}function Zm(i,t,e,n){return y("button",{type:"button","data-test":i,title:e,onclick:n},t)}function jm({plan:i},t,e){let n=t.via.map(s=>i.content.parts.id[s]);return{kind:"direction",source:t.source,target:t.target,via:n,flow:e}}function MM(i){let{plan:t,store:e}=i,[n]=e.shown.selection;if(e.shown.selection.length!==1||n===void 0)return null;let s=t.content.network.joints.filter(r=>(r.first===n||r.second===n)&&(r.made||r.score>=xo));return s.length?(s.sort((r,o)=>Number(r.made)-Number(o.made)||o.score-r.score),y("details",{class:"net-card","data-test":"net-joints",open:s.length<=6||s.some(r=>!r.made)},y("summary",{},`Joints of this part (${s.length})`),y("ul",{class:"net-joints"},...s.slice(0,30).map(r=>TM(i,r,n))))):null}function TM(i,t,e){let{plan:n,panels:s,editable:r}=i,{parts:o}=n.content,a=t.first===e?t.second:t.first,l=n.placeOfPart.get(a),c=o.name[a]??n.content.groups[o.group[a]]?.name??"part",h=l?`${c} of ${n.places.get(l).name}`:c,u={first:o.id[t.first],second:o.id[t.second]};return y("li",{class:t.made?"":"is-unsure",title:t.reasons.join("; ")},y("button",{type:"button",class:"net-link",onclick:()=>i.goParts([a])},h),y("span",{class:"net-soft"},[t.kind,`${(1e3*Math.abs(t.gap)).toFixed(1)} mm`,Gu(t.score),...t.made?[]:["not joined"]].join(", ")),r&&(t.made?Zm("net-cut","Cut here","These two do not join",()=>{s.edit([{kind:"cut",...u}])}):Zm("net-join","Join","These two join",()=>{s.edit([{kind:"join",...u}])})))}function Qm(i,t){return i.flow==="unknown"?"\u2013":i.source===t==(i.flow==="forward")?"\u2192":"\u2190"}function EM(i,t){return{"\u2013":"direction unknown","\u2192":"flows away from it","\u2190":"flows to it"}[Qm(i,t)]}function tg(i,t,e){let n=ng(i);return i.content.network.connections.map((s,r)=>{let o=vs(s),a={color:ig(i,r,t.by,e,n),width:3,dashed:o!=="known",arrows:o!=="unknown",shown:t.isShown(r),strong:!1,dim:!1},l=t.marks?.connections.has(r)??!1;return t.marks&&!l&&Object.assign(a,{color:e.faint,width:1.5,arrows:!1,dim:!0}),l&&Object.assign(a,{color:e.mark,width:4.5,shown:!0,strong:!0}),t.hovered.has(r)&&(a.width+=2),t.selected.has(r)&&Object.assign(a,{color:e.selected,width:5,shown:!0,strong:!0,dim:!1}),a})}function eg(i,t,e,n){let[s]=i.content.network.lines[t].connections;return`rgb(${(s===void 0?n.faint:ig(i,s,e,n,ng(i))).map(o=>Math.round(255*o)).join(" ")})`}function ng(i){return[...new Set(i.content.network.connections.map(t=>t.size??0))].sort((t,e)=>t-e)}function ig(i,t,e,n,s){let r=i.content.network.connections[t];if(e==="flow")return r.flow==="unknown"?n.unknown:n.known;if(e==="size")return AM(n.ramp,s.indexOf(r.size??0)/Math.max(1,s.length-1));let a=i.content.network.lines[r.line]?.system??i.places.get(r.source)?.system??-1,l=e==="line"?r.line:a;return l<0?n.faint:n.several[l%n.several.length]}function AM([i,t],e){return[0,1,2].map(n=>i[n]+e*(t[n]-i[n]))}function CM(i){let t=/^#([0-9a-f]{6})$/i.exec(i.trim())?.[1]??"000000";return[0,2,4].map(e=>parseInt(t.slice(e,e+2),16)/255)}function ql(i){let t=getComputedStyle(i),e=n=>CM(t.getPropertyValue(n));return{known:e("--net-known"),unknown:e("--net-unknown"),selected:e("--net-selected"),mark:e("--net-mark"),faint:e("--net-faint"),casing:e("--net-casing"),several:[1,2,3,4,5,6,7,8].map(n=>e(`--net-${n}`)),ramp:[e("--net-small"),e("--net-large")]}}var PM={flow:"flow",line:"line",system:"system",size:"size"},Yl=300,Jl=class{head=y("div",{class:"net-tab-head"});list=y("div",{class:"net-tree","data-test":"net-tree"});search=y("input",{type:"search",placeholder:"Filter: tag, kind, DN","aria-label":"Filter the network","data-test":"net-filter",oninput:()=>this.fillList()});open=new Set([0]);rows=new Map;signs=new Map;context;constructor(t,e){this.context=e,t.classList.add("net-tab"),t.append(this.head,this.search,this.list)}fill(){this.fillHead(),this.fillList()}fillHead(){let{store:t,focus:e}=this.context,{network:n}=this.context.planNow().content,{connections:s}=n,{shown:r}=t,o=(u,d,f,p,b)=>y("button",{type:"button","data-test":u,"aria-pressed":String(p),title:`${d} (${f})`,onclick:()=>zn(b)},d),a=y("select",{"data-test":"net-lines-by","aria-label":"Colour the lines by",onchange:u=>e.set({linesBy:u.target.value})},...Object.entries(PM).map(([u,d])=>y("option",{value:u,selected:u===e.linesBy},d))),l=s.filter(u=>u.flow==="unknown").length,c=s.filter(u=>vs(u)==="doubtful").length,h=n.systems.reduce((u,d)=>u+(d.length??0),0);this.head.replaceChildren(y("div",{class:"net-buttons"},o("net-toggle-lines","Lines","n",r.network,"network.lines"),o("net-toggle-tags","Tags","t",r.tags,"network.tags"),o("net-toggle-schematic","Schematic","d",r.schematic,"network.schematic"),o("net-toggle-moving","Moving flow","no key",e.moving,"network.moving")),y("label",{class:"net-row"},"Colour lines by ",a),e.linesBy==="flow"?LM(s.length-l-c,c,l):"",y("p",{class:"net-soft","data-test":"net-counts"},[wn(n.units.length,"unit"),wn(n.lines.length,"line"),wn(n.systems.length,"system"),`${Li(h)} of pipe`].join(", ")),this.warningRow())}paint(){let t=ql(this.list),e=this.context.planNow();for(let[n,s]of this.signs)e.content.network.lines[n]&&(s.style.borderTopColor=eg(e,n,this.context.focus.linesBy,t))}mark(){let{focus:t}=this.context,e=t.place?.id;for(let[n,s]of this.rows){let r=n===`place ${e}`||n===`line ${t.selectedLine}`;s.classList.toggle("is-selected",r),r&&!s.hasAttribute("aria-current")&&s.scrollIntoView({block:"nearest"}),r?s.setAttribute("aria-current","true"):s.removeAttribute("aria-current")}}warningRow(){let{focus:t}=this.context,e=this.context.warningsNow();if(!e.length)return y("p",{class:"net-soft"},"No warnings in the network.");let n=e.findIndex(a=>a.key===t.warning),s=["missing","joint","open"].map(a=>e.filter(l=>l.kind===a).length),r=[s[0]?`${wn(s[0],"unit")} without all lines`:"",s[1]?`${wn(s[1],"unjoined face")}`:"",s[2]?wn(s[2],"open end"):""].filter(Boolean).join(", "),o=(a,l,c,h)=>y("button",{type:"button",title:`${l} (${c})`,"aria-label":l,onclick:()=>zn(h)},a);return y("div",{class:"net-row net-warning-row","data-test":"net-warnings"},y("span",{class:"net-warn-sign","aria-hidden":"true"},"!"),y("span",{},r),y("span",{class:"net-row-end"},o("\u2039","Previous warning","W","network.warning.previous"),y("span",{class:"net-soft"},`${n<0?"\u2013":n+1}/${e.length}`),o("\u203A","Next warning","w","network.warning.next"),y("button",{type:"button",title:"Show warnings in the view","aria-pressed":String(t.warnings),"data-test":"net-toggle-warnings",onclick:()=>t.set({warnings:!t.warnings})},"Show")))}fillList(){let{network:t}=this.context.planNow().content,e=this.search.value.toLowerCase().split(/\s+/).filter(Boolean);this.rows.clear(),this.signs.clear();let n=[];t.systems.forEach((s,r)=>{n.push(this.block(r,s.id,`${Li(s.length)}${s.sizes.length?`, DN ${RM(s.sizes)}`:""}`,e))}),t.units.some(s=>s.system<0)&&n.push(this.block(-1,"Not connected","",e)),this.list.replaceChildren(...n.filter(s=>!s.hidden)),this.list.childElementCount||this.list.append(y("p",{class:"net-empty"},e.length?"Nothing in the network is called so.":"No units were found.")),this.mark(),this.paint()}block(t,e,n,s){let r=this.context.planNow(),{network:o}=r.content,a=f=>s.every(p=>f.toLowerCase().includes(p)),l=o.lines.map((f,p)=>({line:f,row:p})).filter(({line:f})=>f.system===t&&a(`${f.tag} line ${ys(f.size)} ${Zl(r,f.start)} ${Zl(r,f.end)}`)),c=o.units.filter(f=>f.system===t&&a(`${f.tag} ${f.kind??""} ${f.type}`)),h=y("div",{class:"net-block"}),u=()=>{if(h.childElementCount)return;h.append(...l.slice(0,Yl).map(({row:p})=>this.lineRow(p)),...c.slice(0,Yl).map(p=>this.unitRow(p.id)));let f=Math.max(0,l.length-Yl)+Math.max(0,c.length-Yl);f&&h.append(y("p",{class:"net-soft"},`and ${f} more: filter to see them`))},d=y("details",{open:s.length>0||this.open.has(t),ontoggle:()=>{d.open&&(u(),this.paint()),!s.length&&(d.open?this.open.add(t):this.open.delete(t),this.mark())}},y("summary",{},y("strong",{},e),y("span",{class:"net-soft"},[n,wn(l.length,"line"),wn(c.length,"unit")].filter(Boolean).join(", "))),h);return d.open&&u(),d.hidden=s.length>0&&!l.length&&!c.length,d}lineRow(t){let{focus:e}=this.context,n=this.context.planNow(),s=n.content.network.lines[t],r=y("span",{class:`net-line-sign${s.flow==="unknown"?" is-unknown":""}`,"aria-hidden":"true"});this.signs.set(t,r);let o={forward:"\u2192",backward:"\u2190"}[s.flow]??"\u2013",a=y("button",{type:"button",class:"net-item","data-test":"net-tree-line","data-line":s.tag,title:`${Zl(n,s.start)} ${o} ${Zl(n,s.end)}, ${Li(s.length)}`,onclick:()=>e.selectLine(t),onpointerenter:()=>e.hoverLine(t),onpointerleave:()=>e.hoverLine(-1)},r,y("span",{class:"net-name"},s.tag),y("span",{class:"net-soft"},`${sg(n,s.start)} ${o} ${sg(n,s.end)}`),y("span",{class:"net-row-end net-soft"},ys(s.size)));return this.rows.set(`line ${t}`,a),a}unitRow(t){let{focus:e,go:n}=this.context,s=this.context.planNow(),r=s.places.get(t),o=y("span",{class:"net-swatch","aria-hidden":"true"}),a=s.content.groups.find(c=>c.unit===r.type)?.color;a&&(o.style.background=a);let l=y("button",{type:"button",class:"net-item","data-test":"net-tree-unit","data-id":t,onclick:()=>n(t),onpointerenter:()=>e.hoverPlace(t),onpointerleave:()=>e.hoverPlace(null)},o,y("span",{class:"net-name"},r.name),y("span",{class:"net-soft"},r.what),r.unit.missing>0&&y("span",{class:"net-row-end is-unsure",title:"Lacks lines that its kind needs"},"! lacks a line"));return this.rows.set(`place ${t}`,l),l}};function Zl(i,t){return i.places.get(t)?.name??t}function sg(i,t){let e=i.places.get(t);return!e||e.unit?e?.name??t:e.type==="junction"?e.name.replace("junction-","J-"):e.type==="blind"?"closed":"open"}function RM(i){let[t,e]=[Math.min(...i),Math.max(...i)];return t===e?String(t):`${t} to ${e}`}function LM(i,t,e){let n=(s,r,o)=>o>0&&y("li",{},y("span",{class:`net-stroke ${s}`,"aria-hidden":"true"}),r,y("span",{class:"net-soft"},String(o)));return y("ul",{class:"net-legend","aria-label":"Lines"},n("is-known","Direction known",i),n("is-doubtful","Not certain",t),n("is-unknown","Direction unknown",e))}var IM={pump:60,tank:60,equipment:55,valve:45,gauge:25};function ag(i,t){let e=[];for(let n of i.places.values())n.type!=="junction"&&e.push(kM(i,n));i.content.network.lines.forEach((n,s)=>{let r=NM(i,s);r&&e.push({...r,text:`${lg(n.tag)}  ${ys(n.size)}`})});for(let n of t)e.push({key:`warning ${n.key}`,kind:"warning",id:n.key,text:n.kind==="open"?"":"!",title:n.title,color:null,point:n.point,reach:n.kind==="open"?.3:3,body:DM(i,n),base:n.kind==="open"?35:70});return e}var rg=32;function lg(i){let t=i.replace(/\s+/g," ").trim();return t.length<=rg?t:`${t.slice(0,rg-1)}\u2026`}function kM(i,t){let{size:e}=t,n=e?Math.hypot(...e):.1,s=i.content.groups.find(r=>r.unit===t.type);return{key:`place ${t.id}`,kind:"place",id:t.id,text:lg(t.name),title:`${t.name}: ${t.what}`,color:s?.color??null,point:t.point,reach:n,body:.5*n,base:t.unit?IM[t.type]??50:5}}function NM(i,t){let e=i.content.network.lines[t],s=e.connections.map(a=>go(i.content.network.connections[a].path)).reduce((a,l)=>l.length>a.length?l:a,{points:[],along:[],length:0});if(s.points.length<2)return null;let r=1;for(let a=1;a<s.points.length;a++)og(s.points,a)>og(s.points,r)&&(r=a);let{point:o}=Nu(s,(s.along[r-1]+s.along[r])/2);return{key:`line ${e.tag}`,kind:"line",id:String(t),text:e.tag,title:`Line ${e.tag}`,color:null,point:o,reach:s.length/20,body:.2,base:15}}function og(i,t){return Zi(i[t-1],i[t])}function DM(i,t){let e=t.place===null?null:i.places.get(t.place)?.size;return e?.5*Math.hypot(...e):.15}function cg(i,t,e){let{focus:n,marks:s}=e;if(i.kind==="warning")return OM(i,t,e);if(i.kind==="line"){let o=Number(i.id);return n.selectedLine===o?850:n.hovered===o?800:!e.shown.tags||s?-1:t.content.network.lines[o].connections.some(n.isConnectionShown)?i.base:-1}let r=t.places.get(i.id);return!s&&!n.isPlaceShown(r)?-1:e.place===i.id?1e3:e.hoveredPlace===i.id?900:s?.close.has(i.id)?700:s?.places.has(i.id)?r.unit?600:500:!e.shown.tags||s||!r.unit||!n.isPlaceShown(r)?-1:i.base}function OM(i,t,{focus:e,marks:n,shown:s}){if(e.warning===i.id)return 2e3;if(!e.warnings||!s.network||n)return-1;let r=t.places.get(i.id.slice(i.id.indexOf(":")+1));return r&&!e.isPlaceShown(r)?-1:i.base}var Xu=[14,30,52].flatMap(i=>[[.8,-.8],[-.8,-.8],[.8,.8],[-.8,.8],[0,-1],[1,0],[-1,0],[0,1]].map(([t,e])=>[t*i,e*i]));function ug(i,t,e){let n=new Map;for(let[o,a,l,c]of t.taken)hg(n,[o,a,l,c]);let s=[],r=[...i].sort((o,a)=>a.rank-o.rank||(o.key<a.key?-1:1));for(let o of r){if(s.length>=e)break;let a=o.fixed?FM(o,t,n):UM(o,t,n);a&&(hg(n,[a.left,a.top,a.left+o.width,a.top+o.height]),s.push(a))}return s}function FM(i,t,e){let n=i.x-i.width/2,s=i.y-i.height/2;return dg(n,s,i,t,e)?{wish:i,left:n,top:s,slot:0}:null}function UM(i,t,e){let n=i.slot>=0&&i.slot<Xu.length?i.slot:0;for(let s=-1;s<Xu.length;s++){let r=s<0?n:s;if(s===n)continue;let[o,a]=Xu[r],l=i.x+o+(o>0?0:o<0?-i.width:-i.width/2),c=i.y+a+(a>0?0:a<0?-i.height:-i.height/2);if(dg(l,c,i,t,e))return{wish:i,left:l,top:c,slot:r}}return null}function dg(i,t,e,n,s){let r=i+e.width,o=t+e.height;if(i<2||t<2||r>n.width-2||o>n.height-2)return!1;let a=!0;return fg(i,t,r,o,l=>{for(let c of s.get(l)??[])i<c[2]+2&&c[0]<r+2&&t<c[3]+2&&c[1]<o+2&&(a=!1)}),a}function hg(i,t){fg(t[0],t[1],t[2],t[3],e=>{let n=i.get(e);n?n.push(t):i.set(e,[t])})}function fg(i,t,e,n,s){for(let r=Math.floor((i-2)/64);r<=(e+2)/64;r++)for(let o=Math.floor((t-2)/64);o<=(n+2)/64;o++)s(r*4096+o)}function pg(i){let{wish:t,left:e,top:n}=i;return{x:Math.min(Math.max(t.x,e),e+t.width),y:Math.min(Math.max(t.y,n),n+t.height)}}var BM=110,zM=3,VM=7,HM=13e3,qu=80,Yu=500,GM=8,WM=20,Kl=class{lastMs=0;root=y("div",{class:"net-tags","data-test":"net-tags"});leaders=se("path",{class:"net-leaders"});dots=se("path",{class:"net-leader-dots"});shown=new Map;hiddenOf=new Map;items=[];byKey=new Map;ranks=[];plan=null;size={width:1,height:1};seenFrom=[];taken=[];dirty=!0;timer=0;widths=new Map;pen=document.createElement("canvas").getContext("2d");view;store;focus;actions;constructor(t,e,n,s){this.view=t,this.store=e,this.focus=n,this.actions=s;let r=se("svg",{class:"net-leader-layer","aria-hidden":"true"},this.leaders,this.dots);this.root.append(r),Wo(this.root),t.element.append(this.root),new ResizeObserver(()=>this.measure()).observe(t.element),this.measure(),t.onFrame(()=>this.frame())}setPlan(t,e){this.plan=t,this.items=ag(t,e),this.byKey=new Map(this.items.map(n=>[n.key,n])),this.pen.font=`600 11px ${getComputedStyle(this.root).fontFamily}`,this.hiddenOf.clear(),this.refresh()}refresh(){if(!this.plan)return;let{shown:t}=this.store,e={shown:t,focus:this.focus,place:this.focus.place?.id??null,hoveredPlace:this.focus.hoveredPlace,marks:t.marks};this.ranks=this.items.map(n=>cg(n,this.plan,e)),this.dirty=!0,requestAnimationFrame(()=>this.frame())}forgetHidden(){this.hiddenOf.clear(),this.rest()}measure(){this.size={width:this.view.element.clientWidth,height:this.view.element.clientHeight},this.dirty=!0,this.frame()}frame(){!this.plan||!this.hasMoved()&&!this.dirty||(this.dirty=!1,this.place(),this.rest())}hasMoved(){let{matrixWorld:t,projectionMatrix:e}=this.view.camera,n=[...t.elements,...e.elements,this.view.depthTurn],s=n.some((r,o)=>r!==this.seenFrom[o]);return s&&(this.seenFrom=n),s}rest(){clearTimeout(this.timer),this.timer=window.setTimeout(()=>this.look(),BM)}place(){let t=performance.now(),e=this.wishes((s,r)=>r>=Yu||this.hiddenOf.get(s.key)===!1),n=Math.min(qu,Math.round(this.size.width*this.size.height/HM));this.draw(ug(e,{...this.size,taken:this.taken},n)),this.lastMs=performance.now()-t}wishes(t){let e=XM(this.view,this.size),n=[];return this.items.forEach((s,r)=>{let o=this.ranks[r];if(o<0||!t(s,o))return;let a=e(s.point);if(!a||a.x<0||a.y<0||a.x>this.size.width||a.y>this.size.height)return;let l=s.reach*a.metre;if(l<VM&&o<Yu)return;let c=this.shown.get(s.key);n.push({key:s.key,x:a.x,y:a.y,width:this.widthOf(s),height:s.kind==="warning"?18:WM,rank:o+Math.min(15,l/10)+(c?GM:0),slot:c?.slot??-1,fixed:s.kind==="warning"})}),n}look(){let t=qM(this.view),e=new Map(this.hiddenOf),n=String(this.taken);this.taken=$M(this.view.element,this.root);let s=n!==String(this.taken),r=this.wishes(()=>!0).sort((h,u)=>u.rank-h.rank),o=this.seenFrom,a=0,l=0,c=()=>{if(o!==this.seenFrom)return;let h=performance.now()+zM;for(;a<r.length&&l<2*qu&&performance.now()<h;){let u=r[a++],d=u.rank<Yu&&this.view.isHidden(YM(this.byKey.get(u.key),t));this.hiddenOf.set(u.key,d),d||l++}a<r.length&&l<2*qu?this.timer=window.setTimeout(c):(s||r.some(({key:u})=>e.get(u)!==this.hiddenOf.get(u)))&&this.place()};c()}draw(t){let e=new Set(t.map(({wish:r})=>r.key));for(let[r,{element:o}]of this.shown)e.has(r)||(o.remove(),this.shown.delete(r));let n="",s="";for(let r of t){let o=this.byKey.get(r.wish.key),a=this.elementOf(o,r.slot);if(a.style.transform=`translate(${Math.round(r.left)}px,${Math.round(r.top)}px)`,this.mark(a,o),o.kind==="warning")continue;let l=pg(r);n+=`M${r.wish.x.toFixed(1)} ${r.wish.y.toFixed(1)}L${l.x.toFixed(1)} ${l.y.toFixed(1)}`,s+=`M${r.wish.x.toFixed(1)} ${r.wish.y.toFixed(1)}h0`}this.leaders.setAttribute("d",n),this.dots.setAttribute("d",s)}elementOf(t,e){let n=this.shown.get(t.key);if(n)return n.slot=e,n.element.textContent!==t.text&&(n.element.textContent=t.text),n.element;let s=y("button",{type:"button",tabindex:"-1",title:t.title,class:`net-${t.kind==="place"?"tag":t.kind}`,"data-test":`net-${t.kind}`,"data-id":t.id,onclick:()=>this.click(t),onpointerenter:()=>this.hover(t,!0),onpointerleave:()=>this.hover(t,!1)},t.text);return t.kind==="warning"&&s.setAttribute("aria-label",t.title),t.kind==="warning"&&t.text===""&&s.classList.add("is-end"),t.color&&(s.style.borderLeftColor=t.color),s.addEventListener("wheel",r=>this.passOn(r),{passive:!1}),this.root.append(s),this.shown.set(t.key,{element:s,slot:e}),s}mark(t,e){let{marks:n}=this.store.shown,s=e.kind==="place"?e.id:null,r=t.classList,o=e.kind==="line"?Number(e.id):-2,a=s!==null&&s===this.focus.place?.id;r.toggle("is-selected",a||o===this.focus.selectedLine||this.focus.warning===e.id),r.toggle("is-hovered",s!==null&&s===this.focus.hoveredPlace||o===this.focus.hovered),r.toggle("is-close",s!==null&&!!n?.close.has(s)),r.toggle("is-marked",s!==null&&!!n?.places.has(s))}click(t){t.kind==="place"?this.actions.place(t.id):t.kind==="line"?this.actions.line(Number(t.id)):this.actions.warning(t.id)}hover(t,e){t.kind==="place"?this.focus.hoverPlace(e?t.id:null):t.kind==="line"&&this.focus.hoverLine(e?Number(t.id):-1)}passOn(t){t.preventDefault(),t.stopPropagation(),this.view.element.querySelector("canvas")?.dispatchEvent(new WheelEvent(t.type,t))}widthOf(t){if(t.kind==="warning")return 18;let e=this.widths.get(t.text);if(e!==void 0)return e;let n=Math.ceil(this.pen.measureText(t.text).width)+16;return this.widths.set(t.text,n),n}};function $M(i,t){let e=i.getBoundingClientRect(),n=[];for(let s of i.children){if(s===t||s.localName==="canvas")continue;let r=s.getBoundingClientRect();!r.width||!r.height||r.width*r.height>.4*e.width*e.height||n.push([r.left-e.left,r.top-e.top,r.right-e.left,r.bottom-e.top])}return n}function XM(i,t){let{camera:e}=i,n=new Mt().multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse).elements,s=.5*t.height*e.projectionMatrix.elements[5];return([r,o,a])=>{let l=n[3]*r+n[7]*o+n[11]*a+n[15];if(l<=1e-6)return null;let c=(n[0]*r+n[4]*o+n[8]*a+n[12])/l,h=(n[1]*r+n[5]*o+n[9]*a+n[13])/l;return{x:(.5+.5*c)*t.width,y:(.5-.5*h)*t.height,metre:s/l}}}function qM(i){let t=i.camera.matrixWorld.elements;return{point:"isOrthographicCamera"in i.camera?null:[t[12],t[13],t[14]],back:[t[8],t[9],t[10]]}}function YM(i,t){let[e,n,s]=i.point,r=t.point?[t.point[0]-e,t.point[1]-n,t.point[2]-s]:t.back,o=Math.hypot(...r)||1,a=(t.point?Math.min(i.body,.9*o):i.body)/o;return[e+r[0]*a,n+r[1]*a,s+r[2]*a]}function mg(i,t,e,n){new Zu(i,t,e,n)}var Zu=class{plan;warnings=[];focus;asking;overlay;motion;tags;schematic;tab;notes=y("div",{class:"net-notes"});paintAsked=!1;view;store;source;panels;constructor(t,e,n,s){this.view=t,this.store=e,this.source=n,this.panels=s;let r=()=>this.plan;this.plan=Pr(e.content),this.focus=new $o(e,r),this.asking=new Ho(e,n,s,r),this.overlay=new Wl(()=>t.element.clientHeight),this.motion=new Xo(t,e,this.focus,this.overlay),t.add(this.overlay.through,!0),t.add(this.overlay.front),s.followLine(()=>e.content?.network.lines[this.focus.selectedLine]??null);let o={place:a=>e.selectPlace(a),line:a=>this.focus.selectLine(a)};this.tags=new Kl(t,e,this.focus,{...o,warning:a=>this.tell(a,!1)}),this.schematic=new $l(s.schematicPane,e,n,this.focus,r,o),this.tab=new Jl(s.networkTab,{store:e,focus:this.focus,planNow:r,warningsNow:()=>this.warnings,go:a=>this.go(a)}),Wo(this.notes),t.element.append(this.notes),this.addCommands(),this.listen(),this.renew()}listen(){let{store:t,focus:e,asking:n}=this;t.on("content",()=>this.renew());let s=this.isEditable();t.on("state",()=>{s!==this.isEditable()&&(s=this.isEditable(),this.fillSlot())}),t.watch(["selection","place"],()=>{this.warnings.find(o=>o.key===e.warning)?.parts.length&&!t.shown.selection.length&&e.set({warning:null}),this.fillSlot(),this.tab.mark()}),t.watch(["selection","place","hovered","marks","hidden","isolated","section","network","tags","theme"],()=>this.paint()),t.watch(["hidden","isolated","section","explode","ghost"],()=>this.tags.forgetHidden()),t.watch(["theme"],()=>requestAnimationFrame(()=>this.tab.paint())),t.watch(["question"],()=>{t.shown.question&&e.warning!==null&&e.set({warning:null})}),t.watch(["schematic"],()=>this.schematic.refresh()),t.watch(["network","tags","schematic"],()=>this.tab.fillHead()),e.onChange(r=>{this.paint(),!r&&(this.tab.fillHead(),this.tab.paint(),this.tab.mark(),this.fillSlot(),this.fillNotes())}),n.onChange(()=>{this.fillSlot(),this.fillNotes()})}renew(){let t=this.plan.content,e=t.network.lines[this.focus.selectedLine]?.tag;this.plan=Pr(this.store.content),this.focus.keepLine(t)||this.panels.say(`Line ${e} is no more: nothing is selected now.`),this.warnings=Xl(this.store.content,this.plan),this.warnings.some(n=>n.key===this.focus.warning)||(this.focus.warning=null),this.overlay.setPlan(this.plan),this.tags.setPlan(this.plan,this.warnings),this.tab.fill(),this.schematic.refresh(),this.asking.again(t),this.fillSlot(),this.fillNotes(),this.paint()}paint(){this.paintAsked||(this.paintAsked=!0,requestAnimationFrame(()=>{this.paintAsked=!1,this.paintNow()}))}paintNow(){let{store:t,focus:e,view:n}=this,{shown:s}=t;this.overlay.visible=s.network||s.marks!==null,this.overlay.setSection(s.section);let r=ql(n.element),o=tg(this.plan,{by:e.linesBy,marks:s.marks,selected:e.connections,hovered:e.hoveredConnections,isShown:e.isConnectionShown},r),a=e.place?.id,l=e.hoveredPlace;this.overlay.setStrokes(o,(c,h)=>{let u=this.plan.places.get(c);return e.isPlaceShown(u)?h?{color:r.known,size:s.marks?0:5}:c===a?{color:r.selected,size:15}:s.marks?s.marks.places.has(c)?{color:r.mark,size:11}:{color:r.faint,size:6}:{color:u.type==="junction"?r.known:u.type==="blind"?r.faint:r.unknown,size:(u.type==="junction"?8:12)+(c===l?4:0)}:{color:r.faint,size:0}},r),this.tags.refresh(),this.schematic.refresh(),this.motion.refresh(),n.invalidate()}isEditable(){let{state:t}=this.store;return this.source.live&&t?.status==="ready"&&t.read_only===null}fillSlot(){this.panels.networkSlot.classList.add("net-slot"),this.panels.networkSlot.replaceChildren(...Jm({plan:this.plan,store:this.store,focus:this.focus,asking:this.asking,panels:this.panels,live:this.source.live,editable:this.isEditable(),go:t=>this.go(t),goParts:t=>this.goParts(t)}))}fillNotes(){let t=this.warnings.findIndex(n=>n.key===this.focus.warning),e={plan:this.plan,store:this.store,focus:this.focus,asking:this.asking,go:n=>this.go(n),goParts:n=>this.goParts(n)};Rf(this.notes,e,this.warnings,t,{step:n=>this.step(n),close:()=>this.focus.set({warning:null})})}go(t){let e=this.plan.places.get(t);e&&(this.store.selectPlace(t),e.parts.length&&this.view.flyTo(e.parts))}goParts(t){t.length&&(this.store.select(t),this.view.flyTo(t))}tell(t,e){let n=this.warnings.find(s=>s.key===t);n&&(this.focus.set({warning:t}),n.place!==null?this.store.selectPlace(n.place):this.store.select(n.parts),e&&n.parts.length&&this.view.flyTo(n.parts))}step(t){let e=this.warnings.length;if(!e){this.panels.say("No warnings in the network.");return}let n=this.warnings.findIndex(r=>r.key===this.focus.warning),s=n<0?t>0?0:e-1:(n+t+e)%e;this.tell(this.warnings[s].key,!0)}addCommands(){let{store:t,focus:e,asking:n,source:s}=this,r="Network",o=()=>s.live,a=l=>{let{place:c}=e;c?.connections.length?l(c.id):this.panels.say(c?`No pipe was found at ${c.name}.`:"Select a unit, a junction or an end first.")};ii({id:"network.lines",key:"n",title:"Lines and flow on the plant",area:r,run:()=>t.set({network:!t.shown.network})},{id:"network.tags",key:"t",title:"Tags",area:r,run:()=>t.set({tags:!t.shown.tags})},{id:"network.schematic",key:"d",title:"Schematic beside the plant",area:r,run:()=>t.set({schematic:!t.shown.schematic})},{id:"network.moving",title:"Let the flow move",area:r,run:()=>e.set({moving:!e.moving})},{id:"network.warning.next",key:"w",title:"Next warning of the network",area:r,run:()=>this.step(1)},{id:"network.warning.end",key:"Escape",title:"End the walk through the warnings",area:r,when:()=>e.warning!==null,run:()=>e.set({warning:null})},{id:"network.warning.previous",key:"W",title:"Previous warning of the network",area:r,run:()=>this.step(-1)},{id:"network.upstream",key:"Shift+ArrowUp",title:"Trace upstream of the selection",area:r,when:o,run:()=>a(l=>n.trace(l,"upstream"))},{id:"network.downstream",key:"Shift+ArrowDown",title:"Trace downstream of the selection",area:r,when:o,run:()=>a(l=>n.trace(l,"downstream"))},{id:"network.to",key:"Shift+ArrowRight",title:"Trace from the selection to what is clicked next",area:r,when:o,run:()=>a(l=>n.startPick(l))},{id:"network.isolate",key:"v",title:"Valves to close to isolate the selected unit",area:r,when:o,run:()=>a(l=>n.isolate(l))},{id:"network.clear",key:"c",title:"End the trace or isolation",area:r,when:()=>!!n.answer||n.picking!==null||!!t.shown.marks,run:()=>n.clear()},{id:"network.sheet.fit",title:"Whole schematic",area:r,when:()=>t.shown.schematic,run:()=>this.schematic.fit()},{id:"network.sheet.selection",title:"Schematic: go to the selection",area:r,when:()=>t.shown.schematic,run:()=>this.schematic.toSelection()})}};function Wn(i,t,e=""){let n=y("span",{class:"bar-fill"});return n.style.width=`${Math.round(100*Math.max(0,Math.min(1,i)))}%`,y("span",{class:`bar ${e}`,role:"img","aria-label":t},n)}var ZM={undo:"M9 7 4 12l5 5M4 12h10a6 6 0 0 1 0 12h-2",redo:"M15 7l5 5-5 5M20 12H10a6 6 0 0 0 0 12h2",help:"M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.1-1.5 2.4M12 18v.01",link:"M10 14a4 4 0 0 0 5.7 0l3-3a4 4 0 0 0-5.7-5.7l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",sun:"M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v3M12 19v3M2 12h3M19 12h3M5 5l2 2M17 17l2 2M19 5l-2 2M7 17l-2 2",moon:"M20 14.5A8.5 8.5 0 0 1 9.5 4 8.5 8.5 0 1 0 20 14.5z",left:"M14 6l-6 6 6 6",right:"M10 6l6 6-6 6",search:"M11 5a6 6 0 1 0 0 12 6 6 0 0 0 0-12zM15.5 15.5 21 21",copy:"M9 9h11v11H9zM5 15H4V4h11v1",close:"M6 6l12 12M18 6 6 18",edit:"M4 20l1-5L16 4l4 4L9 19zM14 6l4 4",table:"M4 5h16v14H4zM4 10h16M4 15h16M10 5v14",drawing:"M4 12h4M16 12h4M8 8l8 8V8l-8 8z",check:"M5 12l5 5 9-10",warn:"M12 4 2.5 20h19zM12 10v5M12 17.5v.01",dot:"M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z"};function Tn(i){return se("svg",{viewBox:i==="undo"||i==="redo"?"0 3 24 24":"0 0 24 24",class:"icon","aria-hidden":"true"},se("path",{d:ZM[i]}))}function qe(i,t,e,n=""){return y("button",{type:"button",class:"icon-button",title:t,"aria-label":t,"data-test":n||null,onclick:e},Tn(i))}function Me(i,t){let e=y("span",{class:`swatch ${i?t:"open"}`,"aria-hidden":"true"});return i&&e.style.setProperty("--swatch",i),e}function Ye(i,t,...e){return y("details",{class:"fold",open:t},y("summary",{},i),...e)}function vo(i,t,e,n=""){let s=y("dialog",{class:`dialog ${n}`,"aria-label":i,"data-test":e});return de(s,y("header",{},y("h2",{},i),qe("close","Close (Esc)",()=>s.close(),"dialog-close")),y("div",{class:"dialog-body"},...t)),s.addEventListener("keydown",r=>r.stopPropagation()),s.addEventListener("click",r=>r.target===s&&s.close()),s.addEventListener("close",()=>s.remove()),document.body.append(s),s.showModal(),s}var JM=["View","Selection","Review","Network","Corrections","Help"],KM=[["Drag","Turn around the point under the pointer"],["Right or middle drag, Shift + drag","Move sideways"],["Wheel, pinch","Nearer and farther, towards the pointer"],["Click","Select a part; click it again for its whole unit"],["Ctrl + click","Add to the selection"],["Double click","Fly to a part"]];function xg(){let i=JM.map(e=>{let n=new Map;for(let s of Uo())s.area!==e||!s.key||n.set(s.title,[...n.get(s.title)??[],QM(s.key)]);return n.size?gg(e,[...n].map(([s,r])=>[r,s])):null}),t=gg("Mouse and touch",KM.map(([e,n])=>[[e],n]));vo("Keys and mouse",[y("div",{class:"help"},t,...i)],"help","wide")}function gg(i,t){let e=y("dl",{});for(let[n,s]of t)de(e,y("dt",{},...n.map(r=>y("kbd",{},r))),y("dd",{},s));return y("section",{},y("h3",{},i),e)}var jM={Escape:"Esc",Backspace:"\u232B Backspace",ArrowUp:"\u2191",ArrowDown:"\u2193",ArrowLeft:"\u2190",ArrowRight:"\u2192"," ":"Space"};function QM(i){return i.replace(/(?<=^|\+)([A-Z])$/,"Shift+$1").split(/(?<=.)\+(?=.)/).map(e=>jM[e]??(e.length===1?e.toUpperCase():e)).join(" + ")}var t1=["group","name","unit","system","cluster","confidence","source","original"],e1=["review","find","network","warnings","history"];function n1(i){let t=[...new Set(i)].sort((s,r)=>s-r),e=[],n=0;for(let s=0;s<t.length;){let r=s;for(;r+1<t.length&&t[r+1]===t[r]+1;)r++;let o=r-s;e.push((t[s]-n).toString(36)+(o?`-${o.toString(36)}`:"")),n=t[r],s=r+1}return e.join(".")}function Ju(i,t){let e=[],n=0;for(let s of i.split(".")){let r=/^([0-9a-z]+)(?:-([0-9a-z]+))?$/.exec(s);if(!r)continue;let o=n+parseInt(r[1],36);if(n=o+(r[2]?parseInt(r[2],36):0),n-o>t)break;for(let a=o;a<=n;a++)a<t&&e.push(a)}return e}var yg=i=>String(Math.round(i*1e3)/1e3);function i1(i){return[...i.eye,...i.target].map(yg).join(",")+(i.orthographic?",o":"")}function s1(i){let t=i.split(","),e=t.slice(0,6).map(Number);return e.length<6||!e.every(Number.isFinite)?null:{eye:e.slice(0,3),target:e.slice(3),orthographic:t[6]==="o"}}function Ku(i,t=2e3){let e=new URLSearchParams;i.camera&&e.set("at",i1(i.camera)),i.place&&e.set("place",i.place),i.colorBy!=="group"&&e.set("by",i.colorBy),i.section&&e.set("cut",`${i.section.axis}${yg(i.section.at)}${i.section.flipped?"!":""}`),i.leftTab!=="find"&&e.set("tab",i.leftTab),i.ghost||e.set("ghost","0");let n=[],s=(r,o,a)=>{let l=n1(o);l&&(e.set(r,l),!(vg(e).length<=t)&&(e.delete(r),n.push(a)))};return!i.place&&i.selection.length&&s("part",i.selection,"the selection"),i.isolated&&s("only",i.isolated,"which parts are isolated"),i.hidden.size&&s("hide",i.hidden,"which parts are hidden"),{fragment:vg(e),left:n.join(" and ")}}function vg(i){return i.toString().replaceAll("%2C",",").replaceAll("%21","!").replaceAll("%3A",":")}function bg(i,t){let e=new URLSearchParams(i.replace(/^#/,"")),n=t.parts.id.length,s={},r=s1(e.get("at")??"");r&&(s.camera=r);let o=e.get("by");s.colorBy=o&&t1.includes(o)?o:"group";let a=e.get("tab");a&&e1.includes(a)&&(s.leftTab=a),s.section=r1(e.get("cut")??""),s.ghost=e.get("ghost")!=="0",s.hidden=new Set(Ju(e.get("hide")??"",n));let l=Ju(e.get("only")??"",n);s.isolated=l.length?new Set(l):null;let c=e.get("place"),h=[...t.network.units,...t.network.ends].find(u=>u.id===c);return s.place=h?.id??null,s.selection=h?h.parts:Ju(e.get("part")??"",n),s}function r1(i){let t=/^([xyz])(-?[\d.]+)(!?)$/.exec(i);return t?{axis:t[1],at:Number(t[2]),flipped:t[3]==="!"}:null}function ee(i,t,e=`${t}s`){return`${ge(i)} ${i===1?t:e}`}function ge(i){return String(Math.round(i)).replace(/\B(?=(\d{3})+(?!\d))/g,",")}function ke(i){if(i===null||!Number.isFinite(i))return"not known";let t=i*100;return t>99&&i<1?"over 99 %":t<1&&i>0?"below 1 %":`${Math.round(t)} %`}function sr(i){if(i===null||!Number.isFinite(i))return"not known";let t=Math.abs(i);return t<1e-5?"0 mm":t<.01?`${(i*1e3).toFixed(1)} mm`:t<1?`${Math.round(i*1e3)} mm`:`${i.toFixed(t<10?2:1)} m`}function jl(i){let t=Array.from(i),e=Math.max(...t.map(Math.abs))>=1;return`${t.map(s=>e?s.toFixed(2):String(Math.round(s*1e3))).join(" \xD7 ")} ${e?"m":"mm"}`}function _g(i){return i===null||!Number.isFinite(i)?"not known":i<.01?`${(i*1e4).toFixed(i<.001?2:1)} cm\xB2`:`${i.toFixed(i<1?3:2)} m\xB2`}function Sg(i){return i===null||!Number.isFinite(i)?"not known (its surface is open)":i<.001?`${(i*1e6).toFixed(i<1e-5?2:0)} cm\xB3`:i<1?`${(i*1e3).toFixed(1)} l`:`${i.toFixed(2)} m\xB3`}var o1={read:"Reading the file",draw:"Making the picture",measure:"Measuring the parts",contacts:"Finding which parts touch",group:"Putting meshes together to parts",cluster:"Finding what stands together",label:"Telling what each part is",relate:"Following the pipes",assemble:"Writing the graph"};function Ql(i){return o1[i]??(i?Ze(i):"Starting")}var a1={sure:"Sure",likely:"Likely, not sure",open:"Not known"};function tc(i){return a1[i]??i}var l1={geometry:"Told from its shape, by the built-in network.",embedded:"Told from its shape, by the built-in network.",network:"Told from the pipes around it.",catalog:"Found in a catalogue of shapes.",author:"Given by the names in the file.",file:"Given by the file.",lvlm:"Told from its picture, by a language model.",human:"Corrected by hand.",repeat:"It has the shape of a part corrected by hand.",kin:"It is much like a part corrected by hand."};function Mg(i){return i===null?"Nobody has said what it is.":l1[i]??`Said by ${i}.`}var c1={ground:"Taken for the ground","unit-short-of-lines":"Units with missing lines",unlabelled:"Parts without a label",likely:"Labels that are likely, not sure","network-in-pieces":"Networks that nothing joins","end-before-part":"Pipes that end just before a part","units-touch-unjoined":"Units that touch and are not joined","line-untraced":"Lines that could not be traced","file-disagrees":"The file says otherwise","file-unknown-label":"Labels of the file that the vocabulary lacks","label-doubted":"Labels that the network doubts","label-outvoted":"Labels that their repeats outvoted","correction-lost":"Corrections that no longer fit","duplicate-mesh":"Meshes that are there twice","near-duplicate-mesh":"Meshes that are nearly there twice","empty-mesh":"Empty meshes","open-mesh":"Meshes with an open surface","one-surface":"Several parts in one surface","split-mesh":"Meshes that were split","nonfinite-vertices":"Meshes with broken points","missing-joint":"Joints that the file names and that are missing","missing-units":"The file does not say its unit of length","missing-up-axis":"The file does not say which way is up","no-centreline":"Pipes without a centre line","no-part":"Meshes that belong to no part","no-component":"Components that were not found","bridged-gap":"Gaps that were bridged","weak-bridge":"Weak joints between clusters","stated-gap":"Gaps between parts that the file joins","stated-unplaced":"Connections of the file without a place","tag-twice":"Tags that are there twice","tag-unusable":"Tags that can't be used","unit-doubt":"Units in doubt","loose-operator":"Operators without a valve","loose-fitting":"Lugs and legs without a vessel","loose-dial":"Dials without a gauge","valve-not-movable":"Valves without a wheel or lever","damaged-source":"The file is damaged","damaged-entity":"Damaged entries of the file","hidden-mesh":"Meshes that nobody can see","inside-out-mesh":"Meshes turned inside out","degenerate-mesh":"Meshes without area","degenerate-faces":"Faces without area","flow-contradiction":"Directions that contradict each other","flow-disagrees":"Directions that the file states otherwise","no-ground":"No ground was found","not-ground":"Not taken for the ground","outside-asset":"References out of the folder","several-bodies":"Meshes of several bodies","unknown-label":"Labels outside the vocabulary","changed-path":"Meshes with another path than before",excluded:"Left out as asked","unmatched-mesh":"Meshes that match nothing"};function ju(i){return c1[i]??i.charAt(0).toUpperCase()+i.slice(1).replaceAll("-"," ")}function ze(i,t){let e=i.parts,n=i.groups[e.group[t]];if(!n)return{name:"No label",group:"",color:null};let s=e.name[t];return{name:s?Ze(s):n.name,group:s?n.name:"",color:n.color}}function Ze(i){return i.charAt(0).toUpperCase()+i.slice(1)}function rr(i){return/^[a-z]+\b(?!-)/.test(i)?Ze(i):i}function bs(i,t){let e=i.network.units[i.parts.unit[t]];return e?`${ze(i,t).name} of ${e.tag}`:ze(i,t).name}var wg=new WeakMap;function Ii(i,t){let e=wg.get(i.meshes);return e||(e=Array.from({length:i.parts.id.length},()=>[]),i.meshes.part.forEach((n,s)=>e[n]?.push(s)),wg.set(i.meshes,e)),e[t]??[]}function or(i,t){return(i.meshes.path[Ii(i,t)[0]]??"").split("/").at(-1)??""}function Qu(i,t){let e=i.shape[t],n=[];for(let s=0;s<i.shape.length;s++)i.shape[s]===e&&n.push(s);return n}function Tg(i,t=new Date){let e=new Date(i);if(!i||Number.isNaN(e.getTime()))return"earlier";let n=(t.getTime()-e.getTime())/6e4;if(n>=-1&&n<1)return"just now";if(n>=0&&n<60)return`${Math.floor(n)} min ago`;let s=`${String(e.getHours()).padStart(2,"0")}:${String(e.getMinutes()).padStart(2,"0")}`;if(e.toDateString()===t.toDateString())return s;let r=["Jan","Feb","Mar","Apr","May","Jun","Jul","Aug","Sep","Oct","Nov","Dec"],o=e.getFullYear()===t.getFullYear()?"":` ${e.getFullYear()}`;return`${e.getDate()} ${r[e.getMonth()]}${o}, ${s}`}function td(i){let t=Math.max(0,Math.floor(i));return t<60?`${t} s`:`${Math.floor(t/60)} min ${String(t%60).padStart(2,"0")} s`}function ar(i){let t=y("dl",{class:"lines"});for(let[e,n]of i)n&&de(t,y("dt",{},e),y("dd",{},n));return t}function gn(i,t,e,n=""){return y("button",{type:"button",class:"link",title:t,"data-test":n||null,onclick:e},i)}function Jt(i,t,e,n="",s=""){return y("button",{type:"button",class:s||null,title:t,"data-test":n||null,"data-key":n||i,onclick:e},i)}function lr(i,t,e,n=40){let s=y("ul",{class:"rows"});for(let r of e.slice(0,n))de(s,y("li",{},ed(i,t,r)));return e.length>n&&de(s,y("li",{class:"soft"},`and ${ee(e.length-n,"more part","more parts")}: see the table`)),s}function ed(i,t,e){let n=ze(t,e);return y("button",{type:"button",class:"row","data-test":"part-row",onclick:()=>i.go([e])},Me(n.color,t.parts.state[e]),y("span",{class:"grow"},bs(t,e)),y("span",{class:"soft"},ke(t.parts.confidence[e])))}function Ji(i,t){let{store:e}=i,n=e.shown.isolated,s=n&&n.size===new Set(t).size&&t.every(r=>n.has(r));return y("div",{class:"buttons",role:"group","aria-label":"View"},Jt("Fly to","Move so that it fills the view (f)",()=>i.view?.flyTo(t),"fly"),Jt(s?"Show all":"Show alone",s?"Show the rest again":"Show only this (i)",()=>e.set({isolated:s?null:new Set(t)}),"isolate-parts"),Jt("Hide","Hide it (h)",()=>e.set({hidden:new Set([...e.shown.hidden,...t]),selection:[],place:null}),"hide"))}function Eg(){let i=y("input",{type:"text",class:"wide",maxlength:300,placeholder:"e.g. seen on P&ID 4711 sheet 2","aria-label":"Why, for the history","data-test":"why"});return{element:y("details",{class:"why"},y("summary",{},"Say why"),i,y("p",{class:"soft"},"It stands beside the correction in the history.")),value:()=>i.value.trim()}}function h1(i,t,e,n){let s=n.has(e.first)?e.second:e.first,r=c=>t.parts.id[c],o={first:r(e.first),second:r(e.second)},a=e.made?Jt("Cut","These two do not join: take the joint away",()=>{i.edit([{kind:"cut",...o}])},"cut","small"):Jt("Join","These two join: make the joint",()=>{i.edit([{kind:"join",...o}])},"join","small"),l=e.made?e.kind:`gap ${sr(e.gap)}, ${ke(e.score)} likely`;return y("li",{class:"joint"},gn(bs(t,s),"Select both and move there",()=>i.go([e.first,e.second])),y("span",{class:"soft grow"},l),i.canEdit()&&a,e.reasons.length>0&&y("details",{class:"reasons"},y("summary",{},"reasons"),y("ul",{},...e.reasons.map(c=>y("li",{},c)))))}function cr(i,t,e){if(e.length<2)return{open:null,made:null};let n=new Set(e),s=t.network.joints.filter(a=>n.has(a.first)!==n.has(a.second)||e.length===2&&n.has(a.first)&&n.has(a.second)),r=a=>a.length?y("ul",{class:"joints"},...a.slice(0,30).map(l=>h1(i,t,l,n))):null,o=s.filter(a=>!a.made&&a.score>=xo).sort((a,l)=>l.score-a.score);return{open:r(o),made:r(s.filter(a=>a.made))}}function Ki(i,...t){return y("div",{class:"note"},Tn("warn"),y("div",{},y("p",{},i),...t))}function Ag(i,t){return Wn(i??0,`Confidence ${ke(i)}`,t)}var u1=["camera","selection","place","colorBy","hidden","isolated","ghost","section","leftTab"],ec=class{page;due=0;written="";constructor(t){this.page=t}start(){location.hash.length>1&&this.read(location.hash),this.page.store.watch([...u1],()=>{clearTimeout(this.due),this.due=window.setTimeout(()=>this.write(),300)}),addEventListener("hashchange",()=>{location.hash.slice(1)!==this.written&&this.read(location.hash)})}read(t){let{store:e}=this.page;e.content&&e.set(bg(t,e.content))}write(){let{fragment:t}=Ku(this.page.store.shown);if(t!==this.written){this.written=t;try{history.replaceState(history.state,"",`#${t}`)}catch{}}}open(){let{store:t,source:e}=this.page;this.page.view&&t.set({camera:this.page.view.getCamera()});let{fragment:n,left:s}=Ku(t.shown),r=t.state?.folder||"the folder",o=t.content?.title??"the plant",a=e.live?`View of ${o}. Run: cadgraph view ${r}
Then press k there and paste this link:
#${n}`:`${location.href.split("#")[0]}#${n}`,l=y("input",{type:"text",class:"wide",placeholder:"Paste a link: #at=\u2026","aria-label":"Link to go to","data-test":"link-input"}),c=y("textarea",{readonly:!0,rows:5,class:"wide","aria-label":"Link","data-test":"link-text"},a),h=()=>{let f=l.value.indexOf("#");if(f<0)return void(u.textContent="A link has a \u201C#\u201D, and what is shown after it.");d.close(),this.read(l.value.slice(f).split(/\s/)[0])},u=y("p",{class:"trouble",role:"alert"});l.addEventListener("keydown",f=>f.key==="Enter"&&h());let d=vo("Link to this view",[y("p",{},e.live?"For a colleague who has the folder: camera, selection, colours, section and what is hidden go with it. It holds no key to this page.":"This file and what is shown of it: send the file along."),c,s?y("p",{class:"trouble","data-test":"link-left"},`Too many parts for a link: ${s} did not go into it.`):null,y("div",{class:"buttons"},Jt("Copy","Copy the link",()=>{this.copy(a)},"link-copy","main"),e.live?Jt("Copy this page's address","Works on this computer while this server runs; it holds the key to the plant, so don't send it",()=>{this.copy(`${location.href.split("#")[0]}#${n}`)},"address-copy"):null),y("h3",{},"Go to a link"),y("div",{class:"spread"},l,Jt("Go","Show what the link shows",h,"link-go")),u].filter(f=>f!==null),"link");d.querySelector("[data-test=link-copy]")?.focus()}async copy(t){try{await navigator.clipboard.writeText(t),this.page.say("Copied.","good")}catch{this.page.say("The browser does not let the page copy: select the text and press Ctrl+C.","bad")}}};var nc=class{element=y("section",{class:"building","data-test":"building","aria-label":"Progress",hidden:!0});started=Date.now();stage=y("p",{class:"building-stage","data-test":"building-stage",role:"status"});fillBar=y("span",{class:"bar-fill"});progress=y("div",{class:"bar big",role:"progressbar","aria-valuemin":"0","aria-valuemax":"100","aria-label":"Progress"},this.fillBar);time=y("p",{class:"soft","data-test":"building-time"});strip=y("p",{class:"making-ready",role:"status","data-test":"making-ready",hidden:!0});steps=y("ol",{class:"steps"});step="";stepped=Date.now();timer=0;showing="";show(t,e,n=""){let s=t?.status==="failed";if(this.strip.hidden=!e||t?.status!=="building",this.strip.hidden||this.say(`${Ql(t.stage)}\u2026 Corrections can be made when this is done.`),(t?.status==="ready"||e&&!s)&&!n){clearInterval(this.timer),this.timer=0,this.showing="",this.element.hidden=!0;return}this.element.hidden=!1;let r=n?"trouble":s?"failed":"building";r!==this.showing&&(this.showing=r,r==="building"?this.layOut(t?.title??""):this.layOutFailed(r==="failed"?"The plant could not be built":"No answer from cadgraph",n||t?.message||"")),r==="building"&&this.update(t)}layOut(t){let e=y("div",{class:"card"},y("p",{class:"brand"},"cadgraph"),y("h1",{},t?`Reading ${t}`:"Reading the plant"),this.steps,this.stage,this.progress,this.time);Lt(this.element,e),this.timer||=window.setInterval(()=>this.tick(),1e3),this.tick()}layOutFailed(t,e){clearInterval(this.timer),this.timer=0,Lt(this.element,y("div",{class:"card",role:"alert"},y("p",{class:"brand"},"cadgraph"),y("h1",{},t),y("p",{class:"building-message","data-test":"building-message"},e),y("p",{class:"soft"},"What went wrong stands in the terminal, too. Put it right there and start 'cadgraph view' again.")))}say(t){this.strip.textContent!==t&&(this.strip.textContent=t)}update(t){let e=Math.max(0,Math.min(1,t?.share??0)),n=[Ql(t?.stage??""),t?.message].filter(Boolean).join(": ");this.progress.classList.toggle("unknown",e===0),this.stage.textContent!==n&&(this.stage.textContent=n),this.stepOn(t?.stage??""),this.fillBar.style.width=`${100*e}%`,this.progress.setAttribute("aria-valuenow",String(Math.round(100*e))),this.progress.setAttribute("aria-valuetext",`${n}, ${ke(e)}`)}stepOn(t){if(t===this.step)return;let e=Date.now();this.step&&this.steps.append(y("li",{},y("span",{},`\u2713 ${Ql(this.step)}`),y("span",{class:"number"},td((e-this.stepped)/1e3)))),this.step=t,this.stepped=e}tick(){this.time.textContent=`${td((Date.now()-this.started)/1e3)} so far`}};function Cg(i,t,e){let n=new Map(t.parts.id.map((l,c)=>[l,c])),s=new Map(e.meshes.path.map((l,c)=>[l,c])),r=!1,o=l=>{let c=n.get(l),h=c===void 0?void 0:Ii(t,c)[0],u=h===void 0?void 0:e.meshes.part[s.get(t.meshes.path[h])??-1];return(u===void 0||u<0)&&(r=!0),e.parts.id[u??-1]??l},a=i.map(l=>{switch(l.kind){case"label":case"forget":case"ground":return{...l,part:o(l.part)};case"merge":case"split":return{...l,parts:l.parts.map(o)};case"join":case"cut":return{...l,first:o(l.first),second:o(l.second)};case"direction":return{...l,via:l.via.map(o)};case"tag":case"device":return l}});return r?null:a}function Pg(i,t,e){let{id:n,shape:s,source:r}=t.parts,o=i.filter(m=>m.kind==="label"),[a]=o;if(!(o.length===i.length&&a&&o.some(m=>!m.this_only))||o.some(m=>m.group!==a.group||m.name!==a.name))return[];let c=new Set(o.map(m=>m.part)),h=new Set(n.flatMap((m,g)=>c.has(m)?[s[g]]:[])),u=e.filter(m=>!c.has(n[m])&&r[m]==="repeat"),d=u.filter(m=>h.has(s[m])),f=m=>m.map(g=>({...a,part:g,this_only:!0})),p=c.size===1,b=[];return d.length&&d.length<u.length&&b.push({text:`Only those of ${p?"its shape":"their shapes"}`,edits:f([...c,...d.map(m=>n[m])])}),u.length&&b.push({text:p?"This part only":"These parts only",edits:f([...c])}),b}var d1=2500,ic=class{store;source;say;chain=Promise.resolve();anew=!0;refusal="";constructor(t,e,n){this.store=t,this.source=e,this.say=n}async edit(t,e=""){if(!t.length)return!0;let n=a=>this.source.edit(a,t,e),s=this.store.content,r=()=>{let a=s&&this.store.content&&Cg(t,s,this.store.content);a?this.edit(a,e):this.say("What you corrected is no more in the plant as it is now.","bad")},o=a=>Pg(t,this.store.content,a.changed).map(l=>({text:l.text,run:()=>{this.instead(a.version,l.edits,e)}}));return await this.send(n,{repeat:r,offer:o})!==null}async instead(t,e,n){await this.revert("Undo",t,!0)&&await this.edit(e,n)}async undo(t=!1){return await this.send(e=>this.source.undo(e),{back:"Redo",quiet:t})!==null}async redo(){return await this.send(t=>this.source.redo(t))!==null}async answer(t,e){let n=typeof e=="object"?e.edits:typeof e=="number"?t.options[e].edits:[],s=this.store.content?.version,r=await this.send(a=>n.length?this.source.edit(a,n,t.title):this.source.answer(a,t.id,typeof e=="object"?"unsure":e),{quiet:!0}),o=r&&r.version!==s?r.version:null;return{ok:r!==null,version:o,message:r===null?void 0:rr(r.message)}}async takeBack(t){return await this.revert("Undo",t)?this.store.content.version:null}async revert(t,e,n=!1){return this.store.state?.version===e?t==="Undo"?this.undo(n):this.redo():(this.say("Something else was corrected since; the buttons above and the list under History go back step by step.","bad"),!1)}heard(t){let e=this.store.state;if(!this.anew&&e&&t.version<e.version)return;this.anew=!1;let n=e?.status==="ready"&&t.status==="ready";this.store.setState(t),!(t.status==="failed"||!this.store.content)&&this.inTurn(async()=>{let{content:s,state:r}=this.store;!s||!r||r.version===s.version||r.status==="failed"||(await this.fetch(),n&&this.say(`Changed in another window${r.message?`: ${r.message}`:""}. The plant is shown as it is now.`))}).catch(s=>this.told(s))}lost(){this.anew=!0}async fetch(){this.store.setContent(await this.source.content())}inTurn(t){let e=this.chain.then(t);return this.chain=e.catch(()=>{}),e}send(t,{repeat:e,back:n="Undo",quiet:s=!1,offer:r}={}){return this.inTurn(async()=>{this.refusal="";let o=setTimeout(()=>this.say("The server is still at work on your correction."),d1);try{let a=await t(this.store.content?.version??0),l=a.version!==this.store.content?.version;if(this.store.apply(a)||await this.fetch(),a.message&&!s){let c=n==="Undo"?a.state.can_undo:a.state.can_redo,h={text:n,run:()=>{this.revert(n,a.version)}};this.say(rr(a.message),"good",l&&c?[h,...r?.(a)??[]]:[])}return a}catch(a){return await this.refused(a,e),null}finally{clearTimeout(o)}})}async refused(t,e){if(!(t instanceof bn)||t.status!==409){this.told(t);return}let n=e?[{text:"Do mine as well",run:e}]:[];t.state&&this.store.setState(t.state);try{await this.fetch(),this.say("Another window was quicker: its correction is shown now, yours was not taken.","bad",n)}catch(s){this.told(s)}}told(t){if(!(t instanceof bn))throw t;this.refusal=rr(t.message);let e={423:"Still building: ",507:"Nothing was changed: "}[t.status]??"";this.say(e+(e?t.message:this.refusal),"bad"),t.state&&this.store.setState(t.state)}};function f1(i){let t={words:[],bores:[],lengths:[]},e=i.toLowerCase().replace(/\bdn\s*(\d+)\b/g,(n,s)=>(t.bores.push(Number(s))," ")).replace(/(^|\s)(\d+(?:[.,]\d+)?)\s*(mm|cm|m)(?=\s|$)/g,(n,s,r,o)=>{let a=Number(r.replace(",","."))*{mm:.001,cm:.01,m:1}[o],l=Math.max(.02*a,6e-4);return t.lengths.push({low:a-l,high:a+l}),s});return t.words=e.split(/\s+/).filter(Boolean),t}var sc=class{content;names=[];paths;bores=new Map;sizes=new Map;constructor(t){this.content=t,this.paths=m1(t);let{parts:e,groups:n,network:s}=t,r=new Map;for(let o=0;o<e.id.length;o++){let a=`${e.group[o]}|${e.name[o]??""}|${e.unit[o]}`,l=r.get(a);l===void 0&&(l=[e.name[o],n[e.group[o]]?.name??"no label",s.units[e.unit[o]]?.tag].filter(Boolean).join(" ").toLowerCase(),r.set(a,l)),this.names.push(l)}for(let o of s.connections)if(o.size!==null){for(let a of[o.source,o.target])this.sizes.set(a,(this.sizes.get(a)??new Set).add(o.size));for(let a of o.via){let l=this.bores.get(a);l?l.includes(o.size)||l.push(o.size):this.bores.set(a,[o.size])}}}find(t,e=200){let n=f1(t);if(!n.words.length&&!n.bores.length&&!n.lengths.length)return{units:[],lines:[],parts:[],totals:{units:0,lines:0,parts:0}};let r=this.rank(this.content.network.units.length,l=>this.unit(l,n),e),o=this.rank(this.content.network.lines.length,l=>this.line(l,n),e),a=this.rank(this.content.parts.id.length,l=>this.part(l,n),e);return{units:r.best,lines:o.best,parts:a.best,totals:{units:r.total,lines:o.total,parts:a.total}}}rank(t,e,n){let s=[[],[],[],[]],r=0;for(let o=0;o<t;o++){let a=e(o);a<0||(r++,s[a].length<n&&s[a].push(o))}return{best:s.flat().slice(0,n),total:r}}unit(t,e){let n=this.content.network.units[t],s=this.sizes.get(n.id),r=l=>s?s.has(l):n.ports.some(c=>p1(c.diameter,l));if(!e.bores.every(r)||!e.lengths.every(l=>n.size.some(c=>yo(c,l))))return-1;let o=n.tag.toLowerCase(),a=n.facts.map(([,l])=>l).join(" ");return nd(o,`${o} ${n.type} ${n.kind??""} ${n.id} ${a}`.toLowerCase(),"",e.words)}line(t,e){let n=this.content.network.lines[t],s=n.size.split(/[^\d.]+/).map(Number);if(!e.bores.every(o=>s.includes(o))||!e.lengths.every(o=>n.length!==null&&yo(n.length,o)))return-1;let r=n.tag.toLowerCase();return nd(r,`${r} line`,"",e.words)}part(t,e){if(e.bores.length&&!e.bores.every(s=>this.bores.get(t)?.includes(s)))return-1;let n=this.content.parts.extents;for(let s of e.lengths)if(!yo(n[3*t],s)&&!yo(n[3*t+1],s)&&!yo(n[3*t+2],s))return-1;return nd(this.names[t],this.names[t],`${this.content.parts.id[t]} ${this.paths[t]}`,e.words)}};function nd(i,t,e,n){if(!n.length)return 2;let s=!0;for(let r of n)if(!t.includes(r)&&(s=!1,!e.includes(r)))return-1;return s?i.startsWith(n.join(" "))?0:n.every(r=>t.startsWith(r)||t.includes(` ${r}`))?1:2:3}var yo=(i,t)=>i>=t.low&&i<=t.high,p1=(i,t)=>i!==null&&Math.abs(i*1e3-t)<=.15*t,Rg=new WeakMap;function m1(i){let t=Rg.get(i.meshes);return t||(t=i.parts.id.map((e,n)=>Ii(i,n).map(s=>i.meshes.path[s]).join(" ").toLowerCase()),Rg.set(i.meshes,t)),t}var hr=(i,t)=>Number(i.toFixed(t));function id(i,t){return{parts:g1,units:x1,lines:v1}[t](i)}function g1(i){let{parts:t,groups:e,network:n}=i,s=new Map;for(let o of t.shape)s.set(o,(s.get(o)??0)+1);let r=b1(i);return[{key:"name",title:"Label",width:13,of:o=>t.name[o]??""},{key:"group",title:"Group",width:13,of:o=>e[t.group[o]]?.name??"no label"},{key:"sure",title:"How sure",width:10,of:o=>tc(t.state[o]).split(",")[0]},{key:"confidence",title:"Conf. %",width:7,number:!0,of:o=>t.confidence[o]===null?null:hr(100*t.confidence[o],1)},{key:"source",title:"Said by",width:9,of:o=>t.source[o]??""},{key:"unit",title:"Unit",width:9,of:o=>n.units[t.unit[o]]?.tag??""},{key:"system",title:"System",width:11,of:o=>n.systems[r(o)]?.id??""},{key:"length",title:"Length m",width:8,number:!0,of:o=>hr(t.extents[3*o],4)},{key:"repeats",title:"Alike",width:6,number:!0,of:o=>s.get(t.shape[o])??1},{key:"triangles",title:"Triangles",width:8,number:!0,of:o=>t.n_triangles[o]},{key:"id",title:"Part",width:10,of:o=>t.id[o]},{key:"path",title:"Path in the file",width:26,of:o=>Ii(i,o).map(a=>i.meshes.path[a]).join(" ")}]}function x1(i){let{units:t,systems:e}=i.network;return[{key:"tag",title:"Tag",width:12,of:n=>t[n].tag},{key:"type",title:"Type",width:10,of:n=>t[n].type},{key:"kind",title:"Kind",width:15,of:n=>t[n].kind??"not known"},{key:"system",title:"System",width:11,of:n=>e[t[n].system]?.id??""},{key:"ports",title:"Ports",width:7,number:!0,of:n=>t[n].ports.length},{key:"missing",title:"Missing lines",width:10,number:!0,of:n=>t[n].missing},{key:"parts",title:"Parts",width:7,number:!0,of:n=>t[n].parts.length},{key:"x",title:"x m",width:8,number:!0,of:n=>hr(t[n].point[0]+i.origin[0],3)},{key:"y",title:"y m",width:8,number:!0,of:n=>hr(t[n].point[1]+i.origin[1],3)},{key:"z",title:"z m",width:8,number:!0,of:n=>hr(t[n].point[2]+i.origin[2],3)}]}function v1(i){let{lines:t,systems:e}=i.network,n=y1(i);return[{key:"tag",title:"Line",width:12,of:s=>t[s].tag},{key:"size",title:"DN",width:8,of:s=>t[s].size},{key:"length",title:"Length m",width:9,number:!0,of:s=>t[s].length===null?null:hr(t[s].length,3)},{key:"start",title:"From",width:13,of:s=>n(t[s].start)},{key:"end",title:"To",width:13,of:s=>n(t[s].end)},{key:"flow",title:"Flow",width:9,of:s=>t[s].flow==="none"?"not known":t[s].flow},{key:"system",title:"System",width:11,of:s=>e[t[s].system]?.id??""}]}function y1(i){let t=new Map;for(let e of i.network.units)t.set(e.id,e.tag);for(let e of i.network.ends)t.set(e.id,e.name);return e=>t.get(e)??e}function b1(i){let{units:t,ends:e,connections:n,lines:s}=i.network,r=new Map;for(let o of s)for(let a of o.connections)for(let l of n[a].via)r.set(l,o.system);for(let o of[...e,...t])if(o.system>=0)for(let a of o.parts)r.set(a,o.system);return o=>r.get(o)??-1}function ji(i,t,e){if(t==="parts")return[e];if(t==="units")return i.network.units[e].parts;let{connections:n,lines:s}=i.network;return[...new Set(s[e].connections.flatMap(r=>n[r].via))]}function w1(i,t){let e=_1(i,t.section);return n=>!t.hidden.has(n)&&(!t.isolated||t.isolated.has(n))&&!e(n)}function _1(i,t){if(!t)return()=>!1;let e="xyz".indexOf(t.axis),{center:n,size:s}=i.parts;return r=>{let o=n[3*r+e],a=s[3*r+e]/2;return t.flipped?o+a<t.at:o-a>t.at}}function Lg(i,t,e,n=id(i,e.kind)){let s={parts:i.parts.id,units:i.network.units,lines:i.network.lines}[e.kind].length,r=w1(i,t),o=new Set(t.selection),a=e.text.toLowerCase().split(/\s+/).filter(Boolean),l=[];for(let h=0;h<s;h++)e.scope==="seen"&&!ji(i,e.kind,h).some(r)||e.scope==="selected"&&!ji(i,e.kind,h).some(u=>o.has(u))||a.length&&!S1(n,h,a)||l.push(h);let c=n.find(h=>h.key===e.sort);return c&&(l=T1(l,c,e.descending)),l}function S1(i,t,e){let n=i.map(s=>s.of(t)??"").join(" ").toLowerCase();return e.every(s=>n.includes(s))}var M1=new Intl.Collator("en",{numeric:!0,sensitivity:"base"});function T1(i,t,e){let n=new Map(i.map(a=>[a,t.of(a)])),s=e?-1:1,r=t.number?null:E1([...new Set(n.values())]),o=a=>r?r.get(n.get(a)):n.get(a);return i.sort((a,l)=>{let[c,h]=[n.get(a),n.get(l)];return+(c===null||c==="")-+(h===null||h==="")||s*((o(a)??0)-(o(l)??0))||a-l})}function E1(i){return new Map(i.sort((t,e)=>M1.compare(t??"",e??"")).map((t,e)=>[t,e]))}function sd(i,t){return ee(t,{parts:"part",units:"unit",lines:"line"}[i])}var Ig=new WeakMap;function A1(i){let t=Ig.get(i);return t||Ig.set(i,t=new sc(i)),t}function rd(i,t,e,n,s){let r=y("div",{class:"found",role:"listbox",id:`${t}-list`,"aria-label":"Found","data-test":`${t}-list`}),o=y("span",{class:"only-read",role:"status"}),a=[],l=-1,c=0,h=y("input",{type:"search",id:t,placeholder:"Find a tag, label, DN80, 0.5 m, path\u2026",role:"combobox",autocomplete:"off",spellcheck:"false","aria-expanded":"false","aria-controls":`${t}-list`,"aria-label":"Find tags, labels, sizes, paths","data-test":t,oninput:()=>{clearTimeout(c),c=window.setTimeout(()=>f(h.value),60)},onkeydown:m=>{if(m.key==="Escape")h.value?f(""):h.blur(),m.stopPropagation();else if(m.key==="ArrowDown")d(l+1);else if(m.key==="ArrowUp")d(l-1);else if(m.key==="Enter")clearTimeout(c),u!==h.value&&f(h.value),a[Math.max(l,0)]?.take();else return;m.preventDefault()}}),u="";function d(m){a[l]?.element.setAttribute("aria-selected","false"),l=a.length?(m+a.length)%a.length:-1,a[l]?.element.setAttribute("aria-selected","true"),a[l]?.element.scrollIntoView({block:"nearest"}),h.setAttribute("aria-activedescendant",a[l]?.element.id??"")}function f(m){let{content:g}=i.store;if(!g)return;h.value!==m&&(h.value=m),u=m,a=[],l=-1;let w=A1(g).find(m,Math.max(e.units,e.lines,e.parts));Lt(r);for(let _ of["unit","line","part"])p(g,w,_);let{totals:S}=w,x=S.units+S.lines+S.parts;m.trim()&&!x&&de(r,y("p",{class:"empty"},`Nothing holds \u201C${m.trim()}\u201D. Tags, labels, paths, part ids, sizes such as DN80 or 350 mm can be found.`)),s&&x&&b(`All ${ge(x)} in the Find tab`,null,"",()=>s(m)),h.setAttribute("aria-expanded",String(x>0)),o.textContent=m.trim()?`${ge(x)} found`:"",a.length&&d(0)}function p(m,g,w){let S=`${w}s`,x=g[S].slice(0,e[S]);if(x.length){de(r,y("h3",{role:"presentation"},ee(g.totals[S],w)));for(let _ of x){let{title:A,detail:v,swatch:M}=C1(m,w,_);b(A,M,v,()=>{n(),w==="unit"?i.go(m.network.units[_].parts,m.network.units[_].id):i.go(ji(m,S,_))})}g.totals[S]>x.length&&!s&&de(r,y("p",{class:"soft"},`and ${ge(g.totals[S]-x.length)} more: the table lists them all`))}}function b(m,g,w,S){let x=y("div",{role:"option",class:"option",id:`${t}-${a.length}`,"aria-selected":"false","data-test":"found",onclick:S},g,y("span",{class:"grow"},m),y("span",{class:"soft"},w));x.addEventListener("pointerdown",_=>_.preventDefault()),a.push({element:x,take:S}),de(r,x)}return i.store.on("content",()=>u&&r.offsetParent&&f(u)),r.append(o),{input:h,list:r,search:f}}function C1(i,t,e){if(t==="unit"){let n=i.network.units[e],s=i.groups.find(r=>r.unit===n.type)?.color??null;return{title:n.tag,detail:n.kind??n.type,swatch:Me(s,n.kind?"sure":"likely")}}if(t==="line"){let n=i.network.lines[e];return{title:n.tag,detail:[n.size&&`DN ${n.size}`,n.length!==null&&sr(n.length)].filter(Boolean).join(", "),swatch:null}}return{title:bs(i,e),detail:or(i,e),swatch:Me(ze(i,e).color,i.parts.state[e])}}var rc=class{element=y("div",{class:"find"});field;constructor(t){this.field=rd(t,"find",{units:100,lines:100,parts:200},()=>{});let e=y("div",{class:"empty hints"},y("p",{},"Search the whole plant:"),y("ul",{},...[["V-0","tags of units and lines"],["gate valve","labels and kinds"],["DN80","what runs in a nominal size"],["350 mm","parts with a side of that length"],["Geo_0004","paths and names of the file, part ids"]].map(([n,s])=>y("li",{},y("button",{type:"button",class:"link",onclick:()=>{this.field.search(n),this.field.input.focus()}},n),y("span",{class:"soft"},s)))),y("p",{class:"soft"},"Arrow keys choose, Enter selects and moves there."));this.element.append(this.field.input,this.field.list,e),t.store.watch(["leftTab"],()=>{t.store.shown.leftTab==="find"&&this.field.input.value&&this.field.search(this.field.input.value)})}open(t){this.field.search(t),this.field.input.focus()}};var P1=/[\p{L}\p{N}][\p{L}\p{N}_./-]*/gu;function kg(i,t){return i.split(/(?<=; )/).flatMap(e=>/ (is|are) now /.test(e)?[{text:e,parts:null,place:null}]:R1(e,t))}function R1(i,t){let e=new Map(t.network.units.map(r=>[r.tag,r])),n=[],s=0;for(let r of i.matchAll(P1)){let o=r[0].replace(/[./-]+$/,""),a=e.get(o),l=a||!o.startsWith("part-")?-1:t.parts.id.indexOf(o);!a&&l<0||(r.index>s&&n.push({text:i.slice(s,r.index),parts:null,place:null}),n.push({text:o,parts:a?.parts??[l],place:a?.id??null}),s=r.index+o.length)}return s<i.length&&n.push({text:i.slice(s),parts:null,place:null}),n}var oc=class{element=y("div",{class:"history","data-test":"history"});page;version=-1;rows=[];trouble="";constructor(t){this.page=t,t.store.watch(["leftTab"],()=>this.refresh()),t.store.on("state",()=>this.refresh()),t.store.on("content",()=>this.refresh())}refresh(){let{state:t,shown:e}=this.page.store;e.leftTab!=="history"||!t||(this.draw(),t.version!==this.version&&(this.version=t.version,this.page.source.audit().then(n=>{this.rows=n,this.trouble="",this.draw()},n=>{this.version=-1,this.trouble=n.message,this.draw()})))}draw(){let{state:t}=this.page.store;if(!t)return;let e=this.page.canEdit();Lt(this.element,t.lost.length>0&&Ki(`${ee(t.lost.length,"correction no longer fits","corrections no longer fit")} this model:`,y("ul",{"data-test":"lost"},...t.lost.map(n=>y("li",{},n)))),e&&y("div",{class:"buttons"},this.step("undo","Undo",t.can_undo,t.undo),this.step("redo","Redo",t.can_redo,t.redo)),this.trouble&&y("p",{class:"trouble"},this.trouble),this.rows.length?y("ol",{class:"audit"},...this.rows.map(n=>this.row(n))):y("p",{class:"empty"},this.page.source.live?"Nothing was corrected yet. What you correct is listed here: who, when, what and why.":"This file holds no history; it is kept in the plant's folder."))}step(t,e,n,s){let r=Jt(e,s?`${e}: ${s}`:`Nothing to ${t}`,()=>{this.page[t]()},`history-${t}`);return r.disabled=!n,r.prepend(Tn(t)),r}row(t){let e=y("time",{datetime:t.when||null,title:t.when?new Date(t.when).toLocaleString():"The time was not kept"},Tg(t.when)),n=this.linked(t.what);return y("li",{class:t.undone?"undone":"","data-test":"audit"},t.undone?y("s",{},...n):y("span",{},...n),t.undone&&y("span",{class:"badge"},"undone"),t.why&&y("p",{class:"audit-why"},t.why),y("p",{class:"soft"},t.who||"somebody",", ",e))}linked(t){let{content:e}=this.page.store;return e?kg(t,e).map(({text:n,parts:s,place:r})=>s?gn(n,`Select what is called ${n} now`,()=>this.page.go(s,r),"audit-link"):n):[t]}};var bo=!1,od=-1;function Ng(i){return bo&&i===od}function Dg(i,t,e,n,s){e!==od&&(bo=!1),od=e,Lt(n,L1(t,e),I1(t,e),i.canEdit()&&k1(i,t,e),Ji(i,[e])),Lt(s,Ye("About this part",!0,D1(i,t,e)),F1(t,e),i.source.live&&U1(i,t,e),i.canEdit()&&Ye("More corrections",!1,z1(i,t,e)))}function L1(i,t){let e=ze(i,t);return y("div",{class:"title"},Me(e.color,i.parts.state[t]),y("div",{class:"grow"},y("h2",{"data-test":"part-name"},e.name),y("p",{class:"soft"},[e.group,i.parts.ground[t]?"ground":""].filter(Boolean).join(" \xB7 ")||"Nothing is known of it yet")))}function I1(i,t){let{state:e,confidence:n,source:s}=i.parts;return y("div",{class:"sureness"},y("div",{class:"spread"},y("b",{class:`state ${e[t]}`,"data-test":"part-state"},tc(e[t])),y("span",{class:"number"},n[t]===null?"":ke(n[t]))),Ag(n[t],e[t]),y("p",{class:"soft"},Mg(s[t])))}function k1(i,t,e){let{parts:n,groups:s}=t,r=Qu(n,e),o=Eg(),a=d=>{let f={kind:"label",part:n.id[e],...d,this_only:bo};i.edit([f],o.value())},l=n.guesses[e].filter(([d])=>s[d]),c=(d,f)=>d===n.group[e]&&f===n.name[e],h=y("div",{class:"guesses",role:"group","aria-label":"What it may be"});for(let[d,f,p]of l){let b=c(d,f);de(h,y("button",{type:"button",class:b?"guess now":"guess","data-test":"guess","data-key":`guess-${d}-${f}`,title:b?"It is labelled so: click to confirm it":r.length>1?`Label it so, or all ${ge(r.length)} of its shape, as chosen below`:"Label it so",onclick:()=>a({group:s[d].name,name:f})},Me(s[d].color,"sure"),y("span",{class:"grow"},Ze(f??s[d].name)),b&&y("span",{class:"tick"},"\u2713 now"),y("span",{class:"number"},ke(p))))}let u=l.map(([d,f])=>({group:s[d].name,name:f}));return de(h,y("button",{type:"button",class:"guess other","data-test":"other-label","data-key":"other-label",title:"Choose any label of the vocabulary (l)",onclick:()=>i.pickLabel(`What is this ${ze(t,e).name.toLowerCase()}?`,u,a)},"Other\u2026")),y("section",{class:"correct","aria-label":"Correct the label"},y("h3",{},n.state[e]==="sure"?"Wrong? Click what it is":"What is it?"),l.length>0&&i.store.shown.question!==null&&y("p",{class:"soft"},"By the labeler alone; the review weighs all evidence."),h,N1(r.length),n.source[e]==="human"&&Jt("Take my correction back","The label it would have without your correction",()=>{i.edit([{kind:"forget",part:n.id[e]}])},"forget"),o.element)}function N1(i){let t=(e,n,s)=>y("label",{},y("input",{type:"radio",name:"reach",checked:bo===e,"data-test":s,onchange:()=>bo=e}),n);return y("fieldset",{class:"reach"},y("legend",{class:"only-read"},"For which parts"),t(!1,i>1?`All ${ge(i)} of its shape, and parts much like it`:"It, and parts much like it","all-alike"),t(!0,"This part only","this-only"),y("p",{class:"soft"},`${i>1?"":"No other part has its shape. "}Which parts look much enough like it is said once it is done, and can be narrowed then.`))}function D1(i,t,e){let{parts:n,network:s}=t,r=s.units[n.unit[e]],o=s.systems[r?.system??-1],a=s.clusters[n.cluster[e]],l=()=>n.cluster.flatMap((h,u)=>h===n.cluster[e]?[u]:[]),c=Qu(n,e);return y("div",{},ar([["Unit",r&&gn(`${r.tag} (${r.kind??r.type})`,"Select the whole unit",()=>i.go(r.parts,r.id),"to-unit")],["System",o&&gn(o.id,"Select all units of the system",()=>i.go(o.units.flatMap(h=>s.units[h].parts)))],["Cluster",a&&gn(`${a.kind??a.id}, ${ee(a.n_parts,"part")}`,"Select the cluster",()=>i.go(l()))],["Alike",c.length>1?gn(ee(c.length,"part"),"Select all parts of this shape",()=>i.go(c),"select-alike"):"no other part"],["Size",jl(n.extents.slice(3*e,3*e+3))],["Area, volume",`${_g(n.area[e])}, ${Sg(n.volume[e])}`],["Triangles",ge(n.n_triangles[e])],["Inside of",n.inside[e]>=0?ed(i,t,n.inside[e]):null],["Part",n.id[e]]]),O1(i,t,e))}function O1(i,t,e){let n=Ii(t,e).map(r=>t.meshes.path[r]),s=()=>navigator.clipboard.writeText(n.join(`
`)).then(()=>i.say("Copied the path."),()=>i.say("The browser does not let the page copy; select the text instead.","bad"));return y("div",{class:"paths"},y("div",{class:"spread"},y("span",{class:"soft"},n.length>1?`In the file (${ee(n.length,"mesh","meshes")})`:"In the file"),qe("copy","Copy the path",s,"copy-path")),...n.slice(0,20).map(r=>y("code",{},r)),n.length>20&&y("p",{class:"soft"},`and ${ge(n.length-20)} more`))}function F1(i,t){let e=i.parts.facts[t];return e.length?Ye("What the file says",!0,ar(e.map(([n,s])=>[Ze(n),s]))):null}function U1(i,t,e){return ad("Why this label?",()=>i.source.explain("part",t.parts.id[e]))}function ad(i,t){let e=y("div",{class:"explain","data-test":"explain","aria-live":"polite"}),n=Ye(i,!1,e);return n.addEventListener("toggle",()=>{!n.open||e.childElementCount||(Lt(e,y("p",{class:"soft"},"Asking\u2026")),t().then(s=>Lt(e,s.length?B1(s):y("p",{class:"soft"},"Nothing is known.")),s=>Lt(e,y("p",{class:"soft"},s.message))))}),n}function B1(i){return ar(i.map(t=>{let[e,...n]=t.trim().split(/\s{2,}/);return n.length?[Ze(e),n.join(" ")]:["",e]}))}function z1(i,t,e){let{parts:n,network:s}=t,r=n.id[e],o=s.units[n.unit[e]],a=n.ground[e];return y("div",{class:"buttons stack"},o&&o.parts.length>1&&Jt(`Split off ${o.tag}`,"This part is a unit of its own",()=>{i.edit([{kind:"split",parts:[r]}])},"split"),Jt("Merge with what I click next","Both are one unit",()=>i.pickNext("Click the part or unit that belongs to the same unit",l=>{l!==e&&i.edit([{kind:"merge",parts:[r,n.id[l]]}])}),"merge"),Jt("Join with what I click next","Both join along the pipes",()=>i.pickNext("Click the part that it joins",l=>{l!==e&&i.edit([{kind:"join",first:r,second:n.id[l]}])}),"join-next"),Jt(a?"It is not the ground":"It is the ground",a?"Count it among the plant again":"Leave it out of clusters, as ground or floor",()=>{i.edit([{kind:"ground",part:r,ground:!a}])},"ground"))}var ac=!1;function Og(i,t,e,n,s){Lt(n,y("div",{class:"title"},y("div",{class:"grow"},y("h2",{"data-test":"many"},`${ee(e.length,"part")} selected`))),Ug(i,t,e),i.canEdit()&&Bg(i,t,e),Ji(i,e));let r=e.length<=50?cr(i,t,e):{open:null};Lt(s,r.open&&Ki("They may join what they were not joined to:",r.open),Ye("Parts",!0,lr(i,t,e)))}function Fg(i,t,e,n,s,r){Lt(s,y("div",{class:"title"},y("div",{class:"grow"},y("h2",{"data-test":"line-tag"},`Line ${e.tag}`),y("p",{class:"soft"},ee(n.length,"part")))),Ji(i,n)),Lt(r,Ye("What it is made of",!0,Ug(i,t,n)),Ye("Parts",!1,lr(i,t,n)),i.canEdit()&&Ye("Correct its parts",!1,Bg(i,t,n)))}function Ug(i,t,e){let{parts:n}=t,s=new Map;for(let a of e){let l=`${n.group[a]}|${n.name[a]}`,c=s.get(l);c?c.push(a):s.set(l,[a])}let r=[...s.values()].sort((a,l)=>l.length-a.length),o=r.slice(0,12).map(a=>{let l=ze(t,a[0]);return y("li",{},y("button",{type:"button",class:"row",title:"Select only these",onclick:()=>i.store.select(a)},Me(l.color,l.color?"sure":"open"),y("span",{class:"grow"},l.name),Wn(a.length/e.length,ke(a.length/e.length)),y("span",{class:"number"},ge(a.length))))});return y("ul",{class:"rows","aria-label":"Labels among them"},...o,r.length>12&&y("li",{class:"soft"},`and ${ee(r.length-12,"more label","more labels")}`))}function Bg(i,t,e){let{parts:n}=t,s=l=>{let c=new Set,h=[];for(let u of e)ac&&c.has(n.shape[u])||(c.add(n.shape[u]),h.push({kind:"label",part:n.id[u],...l,this_only:!ac}));i.edit(h)},r=e.map(l=>n.id[l]),o=new Set(e.map(l=>n.unit[l])),a=o.size===1&&!o.has(-1)?t.network.units[[...o][0]]:null;return y("section",{class:"correct","aria-label":"Correct them"},y("div",{class:"buttons"},Jt("Label them all\u2026","Choose one label for all of them (l)",()=>i.pickLabel(`What are these ${ge(e.length)} parts?`,[],s),"label-all","main"),Jt("Merge as one unit","They are one unit together",()=>{i.edit([{kind:"merge",parts:r}])},"merge-all"),a&&e.length<a.parts.length&&Jt(`Split off ${a.tag}`,"They are a unit of their own",()=>{i.edit([{kind:"split",parts:r}])},"split-all"),e.length===2&&Jt("Join these two","They join along the pipes",()=>{i.edit([{kind:"join",first:r[0],second:r[1]}])},"join-two")),y("label",{class:"check"},y("input",{type:"checkbox",checked:ac,onchange:l=>ac=l.target.checked}),"and all other parts of the same shapes"))}function zg(i,t,e,n,s){let r=t.network.units.indexOf(e),o=t.groups.find(c=>c.unit===e.type)?.color??null;Lt(n,y("div",{class:"title"},Me(o,e.kind?"sure":"likely"),V1(i,e)),G1(i,e),e.handling&&y("p",{"data-test":"unit-handling"},Ze(e.handling)),W1(i,t,e),Ji(i,e.parts),X1(i,e));let a=cr(i,t,e.parts),l=t.network.systems[e.system];Lt(s,!e.missing&&a.open&&Ki("It may join what it was not joined to:",a.open),Ye("About this unit",!0,ar([["System",l&&gn(`${l.id}, ${ee(l.units.length,"unit")}`,"Select all units of the system",()=>i.go(l.units.flatMap(c=>t.network.units[c].parts)))],["Size",jl(e.size)],["Place",e.point.map((c,h)=>(c+t.origin[h]).toFixed(2)).join(", ")+" m"],...e.facts.map(([c,h])=>[Ze(c),h]),["Unit",e.id]])),Ye(`Ports (${e.ports.length})`,e.ports.length<5,$1(e)),Ye(`Parts (${e.parts.length})`,e.parts.length<13,lr(i,t,e.parts)),i.source.live&&ad("Why this unit?",()=>i.source.explain("unit",e.id)),a.made&&Ye("Joints",!1,a.made),i.canEdit()&&Ye("More corrections",!1,q1(i,t,e,r)))}function Vg(i,t){let e=y("div",{class:"grow tag-line"}),n=t.name.toLowerCase(),s=()=>Lt(e,y("div",{class:"spread"},t.shown,i.canEdit()&&qe("edit",t.change,r,`edit-${n}`))),r=()=>{let o=t.offered&&y("datalist",{id:`${n}-offered`},...t.offered.map(h=>y("option",{value:h}))),a=y("input",{type:"text",value:t.value,maxlength:80,"aria-label":t.name,"data-test":`${n}-input`,spellcheck:"false",list:o?o.id:null}),l=y("p",{class:"trouble",role:"alert"}),c=async()=>{let h=a.value.trim();if(h===t.value)return s();if(!h)return void(l.textContent=t.empty);a.disabled=!0;let u=await i.edit([t.edit(h)]);if(a.disabled=!1,u)return a.blur();a.isConnected&&(l.textContent=i.refusal()||"This was not taken.",a.focus())};a.addEventListener("keydown",h=>{if(h.key==="Enter")c();else if(h.key==="Escape")s();else return;h.preventDefault(),h.stopPropagation()}),Lt(e,y("div",{class:"spread"},a,Jt("Save",`${t.change}: take this`,()=>{c()},`${n}-save`,"main")),o,l),a.select()};return s(),e}function V1(i,t){return Vg(i,{name:"Tag",shown:y("h2",{"data-test":"unit-tag"},t.tag),value:t.tag,change:"Change the tag",empty:"A tag has at least one letter.",edit:e=>({kind:"tag",unit:t.id,tag:e})})}var H1={valve:["ball valve","butterfly valve","check valve","control valve","diaphragm valve","gate valve","globe valve","needle valve","plug valve","pressure reducing valve","relief valve","safety valve","solenoid valve","three-way valve"],gauge:["flow meter","level gauge","pressure gauge","sight glass","temperature gauge","thermowell","transmitter"],pump:["centrifugal pump","diaphragm pump","gear pump","piston pump","screw pump"],tank:["column","horizontal tank","tank","vessel"]};function G1(i,t){let e=t.kind_guesses.slice(0,4),n=r=>({kind:"device",unit:t.id,device:r}),s=r=>i.canEdit()?gn(Ze(r),`${t.tag} is a ${r}`,()=>{i.edit([n(r)])},"kind-guess"):Ze(r);return y("div",{class:"sureness"},Vg(i,{name:"Kind",shown:y("p",{"data-test":"unit-kind"},Ze(t.kind??`${t.type}, kind not known`)),value:t.kind??"",change:"Say what it is",empty:"Say in words what it is, as in check valve.",offered:H1[t.type]??[],edit:n}),e.length>0&&y("ul",{class:"rows"},...e.map(([r,o])=>y("li",{class:"row"},y("span",{class:"grow"},s(r)),Wn(o,ke(o)),y("span",{class:"number"},ke(o))))),e.length>1&&y("p",{class:"soft"},i.canEdit()?"Nobody is sure: say what it is, or correct the label of what turns it.":"The kind follows the labels of its parts."))}function W1(i,t,e){if(e.missing<=0)return null;let n=cr(i,t,e.parts).open;return Ki(`${ee(e.missing,"line is","lines are")} missing: a ${e.kind??e.type} needs more lines than were found here.`,y("p",{class:"soft"},n?"It may join one of these:":"Look for a wrong label beside it, or join it by hand (More corrections)."),n)}function $1(i){return i.ports.length?y("ul",{class:"rows"},...i.ports.map(t=>y("li",{class:"row"},y("b",{},t.name),y("span",{class:"grow soft"},t.diameter===null?"diameter not known":`\u2300 ${sr(t.diameter)}`)))):y("p",{class:"soft"},"No port was found.")}function X1(i,t){if(t.parts.length<2)return null;let e=()=>{let r=i.store.shown.explode;return r?.unit===t.id?Math.round(100*r.share):0},n=y("input",{type:"range",min:0,max:100,value:e(),"aria-label":"Draw its parts apart","data-test":"explode","data-key":"explode"});n.addEventListener("input",()=>{let r=Number(n.value)/100;i.store.set({explode:r?{unit:t.id,share:r}:null})});let s=i.store.watch(["explode"],()=>{n.isConnected?n.value=String(e()):s()});return y("label",{class:"slider"},"Explode",n)}function q1(i,t,e,n){let s=r=>t.parts.id[r];return y("div",{class:"buttons stack"},Jt("Merge with the unit I click next","Both are one unit",()=>i.pickNext(`Click the unit that ${e.tag} belongs to`,r=>{let o=t.network.units[t.parts.unit[r]];t.parts.unit[r]===n?i.say(`That is ${e.tag} itself.`):i.edit([{kind:"merge",parts:[...e.parts,...o?.parts??[r]].map(s)}])}),"merge"),e.parts.length>1&&Jt("Split off the part I click next","That part is a unit of its own",()=>i.pickNext(`Click the part that does not belong to ${e.tag}`,r=>{t.parts.unit[r]===n?i.edit([{kind:"split",parts:[s(r)]}]):i.say(`That part does not belong to ${e.tag}.`)}),"split"),Jt("Join with the part I click next","They join along the pipes",()=>i.pickNext(`Click the part that joins ${e.tag}`,r=>{let o=Hg(t,e.parts,r);t.parts.unit[r]!==n&&i.edit([{kind:"join",first:s(o),second:s(r)}])}),"join-next"))}function Hg(i,t,e){let{center:n,size:s}=i.parts,r=o=>Math.hypot(...[0,1,2].map(a=>Math.max(0,Math.abs(n[3*o+a]-n[3*e+a])-(s[3*o+a]+s[3*e+a])/2)));return t.reduce((o,a)=>r(a)<r(o)?a:o,t[0])}var Y1={junction:["Junction","Lines meet here."],open:["Open end","A pipe ends here without a cap: it leads out of the model, or something is missing."],blind:["Blind end","A cap or a blind flange closes the pipe here."],unknown:["End of a pipe","It is not known whether it is open or closed."]};function Gg(i,t,e,n,s){let[r,o]=Y1[e.kind];Lt(n,y("div",{class:"title"},y("div",{class:"grow"},y("h2",{"data-test":"end-name"},r),y("p",{class:"soft"},e.name))),y("p",{},o),Ji(i,e.parts));let a=cr(i,t,e.parts),l=e.parts[0];Lt(s,a.open&&Ki("Near it, not joined:",a.open),i.canEdit()&&e.kind!=="junction"&&l!==void 0&&y("div",{class:"buttons"},Jt("Join with the part I click next","They join along the pipes",()=>i.pickNext("Click the part that this end joins",c=>{e.parts.includes(c)||i.edit([{kind:"join",first:t.parts.id[Hg(t,e.parts,c)],second:t.parts.id[c]}])}),"join-next")),Ye("Parts here",!0,lr(i,t,e.parts)),a.made&&Ye("Joints",!1,a.made))}var lc=class{element;networkSlot=y("div",{class:"network-slot","data-test":"network-slot"});lineNow=()=>null;head=y("div",{class:"inspector-head"});rest=y("div",{class:"inspector-rest"});page;open=new Map;due=!1;drawn={selection:[],place:null};late=!1;constructor(t){this.page=t,this.element=y("section",{class:"inspector","aria-label":"Selection","data-test":"inspector"},this.head,this.networkSlot,this.rest),this.rest.addEventListener("toggle",n=>this.noteToggle(n.target),!0),this.element.addEventListener("focusout",()=>this.late&&this.render()),t.store.watch(["selection","place","isolated"],()=>this.render()),t.store.on("content",()=>this.render());let e=t.canEdit();t.store.on("state",()=>{e!==t.canEdit()&&this.render(),e=t.canEdit()})}render(){this.due||(this.due=!0,queueMicrotask(()=>{this.due=!1;let{content:t,shown:e}=this.page.store;if(!t||(this.late=this.typing(),this.late))return;let n=document.activeElement?.dataset?.key,s=this.element.contains(document.activeElement),r=e.selection!==this.drawn.selection||e.place!==this.drawn.place;this.draw(t,e.selection,e.place),this.restoreOpen(),r&&(this.element.scrollTop=0),s&&n&&this.element.querySelector(`[data-key="${CSS.escape(n)}"]`)?.focus({preventScroll:!0})}))}typing(){let t=document.activeElement,{selection:e,place:n}=this.page.store.shown;return e===this.drawn.selection&&n===this.drawn.place&&t instanceof HTMLInputElement&&t.type==="text"&&!t.disabled&&this.element.contains(t)}draw(t,e,n){this.drawn={selection:e,place:n};let s=n&&t.network.units.find(a=>a.id===n),r=n&&t.network.ends.find(a=>a.id===n),o=this.lineNow();o?Fg(this.page,t,o,e,this.head,this.rest):s?zg(this.page,t,s,this.head,this.rest):r?Gg(this.page,t,r,this.head,this.rest):e.length===1?Dg(this.page,t,e[0],this.head,this.rest):e.length>1?Og(this.page,t,e,this.head,this.rest):this.overview(t)}overview(t){let{parts:e,network:n}=t,s={sure:0,likely:0,open:0};for(let c of e.state)s[c]++;let r=e.id.length,o=["sure","likely","open"].map(c=>y("li",{class:"row"},Me(c==="open"?null:"var(--accent)",c),gn({sure:"Sure",likely:"Likely, not sure",open:"Not known"}[c],"Select these parts",()=>this.page.store.select(e.state.flatMap((h,u)=>h===c?[u]:[]))),y("span",{class:"grow"}),Wn(s[c]/Math.max(r,1),ke(s[c]/Math.max(r,1)),c),y("span",{class:"number"},ge(s[c])))),{canEdit:a,store:l}=this.page;Lt(this.head,y("div",{class:"title"},y("div",{class:"grow"},y("h2",{},t.title),y("p",{class:"soft"},`${ee(r,"part")}, ${ee(n.units.length,"unit")}, ${ee(n.lines.length,"line")}, ${ee(n.systems.length,"system")}`))),y("h3",{},"How sure the labels are"),y("ul",{class:"rows"},...o)),Lt(this.rest,y("div",{class:"empty"},y("p",{},"Click a part to see what it is and how sure that is. Click it again for its whole unit."),a()&&y("p",{},"A wrong label? Click the part, then click what it is: all parts of its shape follow.")),a()&&y("div",{class:"buttons"},Jt("Start the review","What is most worth a look first (r)",()=>l.set({leftTab:"review"}),"start-review","main")))}noteToggle(t){t.classList.contains("fold")&&this.open.set(t.querySelector("summary").textContent.replace(/ \(\d+\)$/,""),t.open)}restoreOpen(){for(let t of this.rest.querySelectorAll("details.fold")){let e=this.open.get(t.querySelector("summary").textContent.replace(/ \(\d+\)$/,""));e!==void 0&&(t.open=e)}}};function wo(i,t){try{localStorage.setItem(`cadgraph.${i}`,t)}catch{}}function ws(i){try{return localStorage.getItem(`cadgraph.${i}`)}catch{return null}}var ld=900,Z1=240;function Wg(i,t,e,n,s){let r=y("main",{class:"middle",id:"view","aria-label":"The plant"}),o=y("section",{class:"schematic-pane",id:"schematic","aria-label":"Schematic","data-test":"schematic"}),{element:a,tabs:l}=K1(i,s),c=y("aside",{class:"right","aria-label":"Inspector",id:"right"},e),h=y("div",{class:"bottom"},o,n),u=y("div",{class:"center"},r,h),d=y("div",{class:"body"},a,u,c),f=y("div",{class:"page"},t,d),p=x=>_=>f.style.setProperty(x,`${_}px`);a.after(cc("Width of the left panel","vertical",{key:"left",start:300,least:230,most:()=>Math.min(520,innerWidth*.45)},p("--left"),(x,_)=>x+_.x)),c.before(cc("Width of the inspector","vertical",{key:"right",start:310,least:240,most:()=>Math.min(560,innerWidth*.45)},p("--right"),(x,_)=>x-_.x)),h.before(cc("Height of the panes below","horizontal",{key:"bottom",start:240,least:100,most:()=>innerHeight*.7},p("--bottom"),(x,_)=>x-_.y)),o.after(cc("Width of the schematic","vertical",{key:"drawing",start:330,least:160,most:()=>(u.clientWidth||innerWidth)-Z1},p("--drawing"),(x,_)=>x+_.x));let b={left:!0,right:!0},m={left:qe("left","Fold the left panel away ([)",()=>g("left"),"fold-left"),right:qe("right","Fold the inspector away (])",()=>g("right"),"fold-right")};for(let x of["left","right"])m[x].classList.add("handle",`handle-${x}`),r.append(m[x]);let g=(x,_=!b[x])=>{b[x]=_,_&&innerWidth<ld&&w(x==="left"?"right":"left",!1),w(x,_),wo(`open-${x}`,String(_))},w=(x,_)=>{b[x]=_,f.classList.toggle(`no-${x}`,!_);let A=x==="left"?"the left panel ([)":"the inspector (])";m[x].title=_?`Fold ${A} away`:`Show ${A}`,m[x].setAttribute("aria-label",m[x].title),m[x].setAttribute("aria-expanded",String(_))};for(let x of["left","right"])w(x,innerWidth>=ld&&ws(`open-${x}`)!=="false");matchMedia(`(max-width: ${ld-1}px)`).addEventListener("change",({matches:x})=>{for(let _ of["left","right"])w(_,!x&&ws(`open-${_}`)!=="false")});let S=()=>{f.classList.toggle("with-drawing",i.shown.schematic),f.classList.toggle("with-table",i.shown.table)};return i.watch(["schematic","table"],S),S(),{root:f,middle:r,schematicPane:o,tabs:l,toggle:g,isOpen:x=>b[x]}}var J1=[["review","Review","What is most worth a look (r)"],["find","Find","Search the plant (/)"],["network","Network","Systems, lines and units"],["warnings","Warnings","What is doubtful"],["history","History","What was corrected"]];function K1(i,t){let e=y("div",{class:"tabs",role:"tablist","aria-label":"Left panel"}),n=new Map,s=y("aside",{class:"left","aria-label":"Review, find, network, warnings, history",id:"left"},e);for(let[o,a,l]of J1){let c=y("span",{class:"badge",hidden:!0}),h=y("button",{type:"button",role:"tab",id:`tab-${o}`,"aria-controls":`panel-${o}`,title:l,"data-test":`tab-${o}`,onclick:()=>i.set({leftTab:o})},a,c),u=y("div",{role:"tabpanel",id:`panel-${o}`,class:"tab-panel","aria-labelledby":`tab-${o}`,tabindex:"-1"},t[o]);n.set(o,{button:h,panel:u,badge:c}),e.append(h),s.append(u)}e.addEventListener("keydown",o=>{let a={ArrowRight:1,ArrowLeft:-1}[o.key];if(!a)return;let l=[...n.keys()].filter(h=>!n.get(h).button.hidden),c=l[(l.indexOf(i.shown.leftTab)+a+l.length)%l.length];i.set({leftTab:c}),n.get(c).button.focus(),o.preventDefault()});let r=()=>{for(let[o,{button:a,panel:l}]of n){let c=o===i.shown.leftTab;a.setAttribute("aria-selected",String(c)),a.tabIndex=c?0:-1,l.hidden=!c}};return i.watch(["leftTab"],r),r(),{element:s,tabs:n}}function cc(i,t,e,n,s){let r=Number(ws(`size-${e.key}`)),o=0,a=y("div",{class:`splitter ${t} split-${e.key}`,role:"separator",tabindex:"0","aria-orientation":t,"aria-label":i}),l=h=>{o=Math.round(Math.max(e.least,Math.min(Math.max(e.most(),e.least),h))),a.setAttribute("aria-valuenow",String(o)),n(o)};l(r>0?r:e.start);let c=()=>wo(`size-${e.key}`,String(o));return a.addEventListener("pointerdown",h=>{a.setPointerCapture(h.pointerId);let u={x:h.clientX,y:h.clientY,now:o},d=f=>l(s(u.now,{x:f.clientX-u.x,y:f.clientY-u.y}));a.addEventListener("pointermove",d),a.addEventListener("lostpointercapture",()=>{a.removeEventListener("pointermove",d),c()},{once:!0}),h.preventDefault()}),a.addEventListener("dblclick",()=>{l(e.start),c()}),a.addEventListener("keydown",h=>{let u={ArrowLeft:[-16,0],ArrowRight:[16,0],ArrowUp:[0,-16],ArrowDown:[0,16]}[h.key];u&&(l(s(o,{x:u[0],y:u[1]})),c(),h.preventDefault(),h.stopPropagation())}),a}var ur=[],j1=4;function Q1(i){return i.groups.flatMap(t=>[{group:t.name,name:null,color:t.color,text:t.name.toLowerCase()},...t.names.map(e=>({group:t.name,name:e,color:t.color,text:`${e} ${t.name}`.toLowerCase()}))])}function tT(i,t){let e=t.toLowerCase().split(/\s+/).filter(Boolean),n=i.filter(r=>e.every(o=>r.text.includes(o))),s=r=>r.text.startsWith(e.join(" "))?0:e.every(o=>` ${r.text}`.includes(` ${o}`))?1:2;return e.length?n.sort((r,o)=>s(r)-s(o)):n}function $g(i,t,e,n){let s=Q1(i),r=p=>s.find(b=>b.group===p.group&&b.name===p.name),o=y("div",{class:"picker-list",role:"listbox",id:"picker-list","aria-label":"Labels"}),a=[],l=0,c=y("input",{type:"text",class:"picker-input",placeholder:"Type a label: valve body, flange, support\u2026",role:"combobox",autocomplete:"off","aria-expanded":"true","aria-controls":"picker-list","aria-label":"Filter labels","data-test":"picker-input",oninput:()=>{l=0,d()},onkeydown:p=>{let b={ArrowDown:1,ArrowUp:-1,PageDown:8,PageUp:-8}[p.key];if(b)l=Math.max(0,Math.min(a.length-1,l+b));else if(p.key==="Enter"&&a[l])u(a[l]);else return;p.preventDefault(),f()}}),h=vo(t,[c,o],"picker","picker");function u(p){h.close();let b={group:p.group,name:p.name},m=ur.findIndex(g=>g.group===p.group&&g.name===p.name);m>=0&&ur.splice(m,1),ur.unshift(b),ur.length=Math.min(ur.length,j1),n(b)}function d(){let p=c.value.trim(),b=p?[]:[...e,...ur].map(r).filter(g=>g!==void 0);a=p?tT(s,p):[...new Set([...b,...s])];let m=a.map((g,w)=>y("div",{role:"option",id:`picker-${w}`,class:g.name?"option":"option whole","data-test":"picker-option",onclick:()=>u(g),onpointermove:()=>{l!==w&&(l=w,f(!1))}},Me(g.color,"sure"),y("span",{class:"grow"},g.name?Ze(g.name):g.group),y("span",{class:"soft"},g.name?g.group:"group only")));b.length&&m[new Set(b).size-1]?.classList.add("last-near"),Lt(o,...m,!a.length&&y("p",{class:"empty"},"No label holds these letters. The vocabulary is what the plant was built with.")),f()}function f(p=!0){[...o.children].forEach((b,m)=>b.setAttribute("aria-selected",String(m===l))),c.setAttribute("aria-activedescendant",`picker-${l}`),p&&o.children[l]?.scrollIntoView({block:"nearest"})}d(),c.focus()}function qg(i,t){return t==="skip"?"skipped":t==="unsure"?"left as unsure":typeof t=="number"?i.options[t]?.text??"":t.text}var hc=class{waiting=[];past=[];loaded=!1;peak=0;replacedAt=-1/0;settled=new Set;turn=0;io;changed;sending=0;chain=Promise.resolve();loading=null;again=!1;constructor(t,e){this.io=t,this.changed=e}get current(){return this.waiting[0]??null}get decided(){return this.past.filter(t=>t.choice!=="skip").length}get busy(){return this.sending>0}load(){return this.loading?(this.again=!0,this.loading):(this.loading=this.fetch().finally(()=>{this.loading=null,this.again&&(this.again=!1,this.load())}),this.loading)}answer(t){let e=this.current;if(!e||typeof t=="number"&&!e.options[t])return Promise.resolve();let n={question:e,choice:t,version:null};this.settled.add(e.id),this.turn++,this.past.push(n),this.waiting=this.waiting.slice(1).filter(r=>!eT(e,t,r)),this.sending++,this.changed();let s=this.chain.then(async()=>{let r=await this.io.send(e,t).catch(()=>({ok:!1,version:null}));this.sending--,this.settled.delete(e.id),r.ok?Object.assign(n,{version:r.version,message:r.message}):this.restore(n),this.sending||await this.load().catch(()=>{}),this.changed()});return this.chain=s,s}async back(){await this.chain;let t=this.past.at(-1);if(!t)return!1;if(t.version!==null){let e=await this.io.takeBack(t.version);if(e===null)return!1;let n=this.past.filter(s=>s!==t&&s.version!==null).at(-1);n?.version===t.version-1&&(n.version=e)}return this.restore(t),this.changed(),!0}show(t){let e=this.waiting.findIndex(n=>n.id===t);e<=0||(this.waiting=[this.waiting[e],...this.waiting.slice(0,e),...this.waiting.slice(e+1)],this.changed())}restore(t){this.past=this.past.filter(e=>e!==t),this.turn++,this.waiting=[t.question,...this.waiting.filter(e=>e.id!==t.question.id)],this.replacedAt=Xg()}async fetch(){let{turn:t}=this,e=await this.io.load();if(t!==this.turn){this.again=!this.sending;return}let n=e.filter(o=>!this.settled.has(o.id)),s=this.current,r=s&&n.find(o=>o.id===s.id);this.waiting=r?[r,...n.filter(o=>o!==r)]:n,s&&!r&&(this.replacedAt=Xg()),this.peak=n.reduce((o,a)=>Math.max(o,a.gain),this.peak),this.loaded=!0,this.changed()}},Xg=()=>performance.now();function eT(i,t,e){if(i.kind!=="label"||e.kind!=="label"||t==="skip"||t==="unsure")return!1;let n=new Set([...i.parts,...i.alike]);return e.parts.every(s=>n.has(s))}var cd=50,nT=500,iT=.1,uc=class{element=y("div",{class:"review","data-test":"review"});queue;page;told=y("p",{class:"only-read",role:"status","aria-live":"polite"});card=y("div",{});changedCount;seen;shownId="";full=!1;trouble="";constructor(t,e,n,s){this.page=t,this.changedCount=n,this.seen=s,this.queue=new hc({load:async()=>{let o=await t.source.review(cd);return this.full=o.length>=cd,o},send:(o,a)=>e.answer(o,a),takeBack:o=>e.takeBack(o)},()=>this.changed()),this.element.append(this.told,this.card),this.addKeys(),t.store.on("content",()=>{!this.queue.busy&&t.store.shown.leftTab==="review"?this.load():this.draw()}),t.store.watch(["leftTab"],()=>this.opened());let r=t.store.state?.status;t.store.on("state",o=>{o.status==="ready"&&r!=="ready"&&this.load(),r=o.status})}viewed(){let{question:t}=this.page.store.shown;this.isOpen&&t&&this.look(t)}look(t){let{content:e,shown:n}=this.page.store;e&&this.page.store.set(Mf(e,n,t.parts)),this.page.view?.flyTo(t.parts)}async load(){if(this.page.store.state?.status==="ready"){try{await this.queue.load(),this.trouble=""}catch(t){this.trouble=t.message}this.changed()}}get left(){return this.queue.loaded?this.full?`${cd}+`:String(this.queue.waiting.length):""}get isOpen(){return this.page.store.shown.leftTab==="review"}opened(){if(!this.isOpen){this.page.store.shown.question&&this.page.store.set({question:null}),this.shownId="";return}this.load()}changed(){if(this.changedCount(),this.draw(),!this.isOpen)return;let t=this.queue.current;if((t?.id??"")===this.shownId){t&&this.page.store.shown.question===null&&this.show(t);return}this.shownId=t?.id??"",this.show(t),t&&(this.look(t),this.told.textContent=`${t.title} ${this.subject(t)}. ${t.options.map((e,n)=>`${n+1}: ${e.text}`).join(", ")}. ${this.left} left.`)}show(t){this.page.store.set({question:t,...t?{selection:t.parts,place:null}:{}})}again(t){this.show(t),this.look(t)}subject(t){let e=this.page.store.content;if(!e||!t.parts.length)return"";let n=[...new Set(t.parts.map(r=>e.network.units[e.parts.unit[r]]?.tag))].filter(Boolean),s=ze(e,t.parts[0]);return!s.group&&!n.length?`No label (${or(e,t.parts[0])})`:`${s.name}${n.length?` of ${n.slice(0,3).join(", ")}`:""}`}answer(t){performance.now()-this.queue.replacedAt<nT||this.queue.answer(t)}other(){let t=this.queue.current,{content:e}=this.page.store;if(!t?.parts.length||!e)return;let n=t.options.flatMap(s=>s.edits).flatMap(s=>s.kind==="label"?[{group:s.group,name:s.name}]:[]);this.page.pickLabel(`${t.title} (${this.subject(t)})`,n,s=>{if(this.queue.current?.id!==t.id)return;let o=(t.kind==="label"?[...t.parts,...t.alike]:t.parts.slice(0,1)).map(a=>({kind:"label",part:e.parts.id[a],...s,this_only:!0}));this.queue.answer({text:s.name??s.group,edits:o})})}async back(){this.queue.past.length?await this.queue.back():this.page.say("There is no answer to take back.")}addKeys(){let t=()=>this.isOpen&&this.seen()&&this.queue.current!==null&&this.page.canEdit();for(let e of[1,2,3,4,5])ii({id:`review-${e}`,key:String(e),title:"Take this answer",area:"Review",when:()=>t()&&this.queue.current.options.length>=e,run:()=>this.answer(e-1)});ii({id:"review-other",key:"o",title:"Another label",area:"Review",when:t,run:()=>this.other()},{id:"review-unsure",key:"u",title:"I am not sure: leave it as it is",area:"Review",when:t,run:()=>this.answer("unsure")},{id:"review-skip",key:"s",title:"Skip: ask me later",area:"Review",when:t,run:()=>this.answer("skip")},{id:"review-back",key:"Backspace",title:"Back: take the last answer back",area:"Review",when:()=>this.isOpen&&this.seen()&&this.page.canEdit()&&this.queue.past.length>0,run:()=>{this.back()}})}draw(){let{content:t}=this.page.store;if(!t||!this.isOpen)return;let e=this.element.contains(document.activeElement)?document.activeElement.dataset.key:void 0,n=this.queue.current;this.trouble&&!n?Lt(this.card,y("div",{class:"empty"},y("p",{},this.trouble),Jt("Ask again","Ask for the queue again",()=>{this.load()}))):this.queue.loaded?n?Lt(this.card,this.progress(),this.lastLine(),this.question(t,n),this.next(t)):Lt(this.card,this.done()):Lt(this.card,y("p",{class:"empty"},"Looking for what is most worth a look\u2026")),e&&this.element.querySelector(`[data-key="${CSS.escape(e)}"]`)?.focus({preventScroll:!0})}progress(){let{decided:t,waiting:e}=this.queue;return y("div",{class:"spread review-progress"},y("b",{"data-test":"review-left"},`${this.left} left`),y("span",{class:"soft","data-test":"review-done"},t?`${ge(t)} answered`:"most worth a look first"),Wn(t/Math.max(t+e.length,1),`${t} answered, ${this.left} left`))}lastLine(){let t=this.queue.past.at(-1);if(!t)return null;let e=t.message&&typeof t.choice!="string"?t.message:`${Ze(qg(t.question,t.choice))}.`;return y("div",{class:"spread last-answer"},y("span",{class:"grow","data-test":"review-last"},`\u2713 ${e}`),this.page.canEdit()&&Jt("Back","Take it back and ask again (Backspace)",()=>{this.back()},"review-back","quiet"))}question(t,e){let n=e.gain/Math.max(this.queue.peak,1e-9),s=e.parts.length?ze(t,e.parts[0]):null,r=e.parts[0],o=this.page.canEdit();return y("section",{class:"question","aria-label":"Question","data-test":"question","data-id":e.id},y("h2",{"data-test":"question-title"},e.title),s&&y("p",{class:"subject"},Me(s.color,t.parts.state[r]),y("span",{},`${e.kind==="label"?"Now: ":""}${this.subject(e)}`)),y("p",{class:"why-line","data-test":"question-why"},rr(e.why)),y("div",{class:"spread gain"},y("span",{class:"soft"},"Gain"),Wn(n,`Gain ${ke(n)} of the greatest`),y("span",{class:"soft","data-test":"alike"},e.alike.length?`settles ${ge(e.alike.length)} more like it`:"this one alone")),n<iT&&y("p",{class:"soft","data-test":"little-gain"},"What is left gains little; you can well stop here."),o?this.options(t,e):y("p",{class:"soft"},"Answers can't be taken: the plant is for looking only."),o&&y("div",{class:"buttons",role:"group","aria-label":"Other answers"},e.parts.length>0&&hd("o","Other\u2026","Choose any label (o)",()=>this.other(),"review-other"),hd("u","Not sure","Leave it as it is, don't ask again (u)",()=>this.answer("unsure"),"review-unsure"),hd("s","Skip","Ask me later (s)",()=>this.answer("skip"),"review-skip")),y("button",{type:"button",class:"link","data-key":"review-look",onclick:()=>this.again(e)},"Show it again"))}options(t,e){let n=y("div",{class:"options",role:"group","aria-label":"Answers"});return e.options.some(s=>s.confidence!==null)&&de(n,y("p",{class:"soft option-head"},y("span",{},"It is"),y("span",{},"by all evidence"))),e.options.slice(0,5).forEach((s,r)=>{let o=s.edits.find(l=>l.kind==="label"),a=o?.kind==="label"?t.groups.find(l=>l.name===o.group)?.color??null:null;de(n,y("button",{type:"button",class:"option-button","data-test":`option-${r+1}`,"data-key":`option-${r+1}`,"aria-keyshortcuts":String(r+1),onclick:()=>this.answer(r)},y("kbd",{},String(r+1)),a&&Me(a,"sure"),sT(s),s.confidence!==null&&Wn(s.confidence,ke(s.confidence)),s.confidence!==null&&y("span",{class:"number"},ke(s.confidence))))}),n}next(t){let e=this.queue.waiting.slice(1,9);return e.length?y("section",{"aria-label":"Next"},y("h3",{},"Next"),y("ul",{class:"rows"},...e.map(n=>{let s=n.parts[0];return y("li",{},y("button",{type:"button",class:"row","data-test":"next-question",title:"Answer this one first",onclick:()=>this.queue.show(n.id)},Me(s===void 0?null:ze(t,s).color,s===void 0?"open":t.parts.state[s]),y("span",{class:"grow"},this.subject(n)||n.title),n.alike.length>0&&y("span",{class:"soft"},`+${ge(n.alike.length)}`)))}))):null}done(){let{decided:t,past:e}=this.queue,n=e.filter(s=>s.choice==="skip").length;return y("div",{class:"empty done","data-test":"review-empty"},y("h2",{},t?"All reviewed":"Nothing to ask"),y("p",{},t?`${ee(t,"answer")} given${n?`, ${n} skipped`:""}. Nothing in this plant is worth another look.`:"No label and no joint of this plant is worth a question."),e.length>0&&this.page.canEdit()&&Jt("Back to the last one","Take the last answer back (Backspace)",()=>{this.back()},"review-back"),y("p",{class:"soft"},"Corrections are kept in the plant's folder. The warnings tab lists what the network still lacks."))}};function sT(i){let t=i.edits.find(s=>s.kind==="label"),e=t?.kind==="label"&&t.name!==null?t.group:"",n=i.text.endsWith(` (${e})`)?i.text.slice(0,-e.length-3):i.text;return y("span",{class:"grow"},Ze(n),n!==i.text&&y("span",{class:"soft small-line"},e))}function hd(i,t,e,n,s){return y("button",{type:"button",title:e,"aria-keyshortcuts":i,"data-test":s,"data-key":s,onclick:n},y("kbd",{},i.toUpperCase()),t)}function Yg(i){if(i===null)return"";if(typeof i=="number")return Number.isFinite(i)?String(i):"";let t=/^\s*[=+\-@\uff1d\uff0b\uff0d\uff20]/.test(i)?`'${i}`:i;return/[",\r\n]/.test(t)||t!==t.trim()?`"${t.replaceAll('"','""')}"`:t}function Zg(i,t){let e=[i.map(Yg).join(",")];for(let n of t)e.push(n.map(Yg).join(","));return`${e.join(`\r
`)}\r
`}function Jg(i,t){rT(i,new Blob(["\uFEFF",t],{type:"text/csv;charset=utf-8"}))}function rT(i,t){let e=document.createElement("a");e.href=URL.createObjectURL(t),e.download=i,e.click(),setTimeout(()=>URL.revokeObjectURL(e.href),1e4)}var _s=24,Kg=8,dc=class{element=y("section",{class:"table-pane","aria-label":"Table","data-test":"table"});page;wish={kind:"parts",scope:"all",text:"",sort:null,descending:!1};head=y("div",{class:"table-head",role:"row","aria-rowindex":"1"});body=y("div",{class:"table-body",role:"rowgroup"});scroll=y("div",{class:"table-scroll",role:"grid",tabindex:"0","aria-label":"Rows: arrow keys choose, Enter moves there","data-test":"table-rows"},this.head,this.body);total=y("span",{class:"soft",role:"status","data-test":"table-count"});kinds=new Map;all=[];rows=[];place=new Map;chosen=new Set;stale=!0;clicked=!1;constructor(t){this.page=t,this.element.append(this.bar(),this.scroll),this.scroll.addEventListener("scroll",()=>this.draw()),this.scroll.addEventListener("keydown",e=>this.key(e)),this.body.addEventListener("click",e=>this.click(e)),this.body.addEventListener("dblclick",e=>this.fly(this.rowOf(e))),new ResizeObserver(()=>this.draw()).observe(this.scroll),t.store.on("content",()=>this.refresh()),t.store.watch(["table"],()=>this.refresh(this.stale)),t.store.watch(["hidden","isolated","section"],()=>this.wish.scope==="seen"&&this.refresh()),t.store.watch(["selection","place"],()=>this.follow())}bar(){let t=y("div",{class:"segments",role:"group","aria-label":"What is listed"});for(let[r,o]of[["parts","Parts"],["units","Units"],["lines","Lines"]]){let a=y("button",{type:"button","aria-pressed":String(r===this.wish.kind),"data-test":`table-${r}`,onclick:()=>this.show(r)},o);this.kinds.set(r,a),de(t,a)}let e=0,n=y("input",{type:"search",placeholder:"Filter rows\u2026","aria-label":"Filter rows","data-test":"table-filter",oninput:r=>{this.wish.text=r.target.value,clearTimeout(e),e=window.setTimeout(()=>this.refresh(),120)}}),s=y("select",{"aria-label":"Which rows","data-test":"table-scope",onchange:r=>{this.wish.scope=r.target.value,this.refresh()}},y("option",{value:"all"},"All"),y("option",{value:"seen"},"Only what is seen"),y("option",{value:"selected"},"In the selection"));return y("div",{class:"table-bar"},t,n,s,this.total,y("span",{class:"grow"}),y("button",{type:"button",class:"quiet",title:"Save the listed rows as CSV","data-test":"csv",onclick:()=>this.save()},"CSV"),y("button",{type:"button",class:"icon-button",title:"Close the table (b)","aria-label":"Close the table",onclick:()=>this.page.store.set({table:!1})},Tn("close")))}show(t){this.wish.kind=t,this.wish.sort=null;for(let[e,n]of this.kinds)n.setAttribute("aria-pressed",String(e===t));this.refresh(),this.scroll.scrollTop=0,this.follow()}refresh(t=!0){let{content:e,shown:n}=this.page.store;if(this.stale=!0,!e||!n.table||!t)return;this.stale=!1,this.all=id(e,this.wish.kind),this.rows=Lg(e,n,this.wish,this.all),this.place=new Map(this.rows.map((o,a)=>[o,a])),this.total.textContent=sd(this.wish.kind,this.rows.length),this.body.style.height=`${Math.max(this.rows.length,1)*_s}px`;let s=this.all.map(o=>`minmax(${o.width*9}px, ${o.width}fr)`).join(" "),r=this.all.reduce((o,a)=>o+a.width*9,0);for(let o of[this.head,this.body])o.style.setProperty("--columns",s),o.style.minWidth=`${r}px`;this.scroll.setAttribute("aria-rowcount",String(this.rows.length+1)),this.titles(),this.mark(e),this.draw()}titles(){Lt(this.head,...this.all.map(t=>{let e=this.wish.sort===t.key;return y("div",{role:"columnheader",class:t.number?"num":null,"aria-sort":e?this.wish.descending?"descending":"ascending":"none"},y("button",{type:"button",title:`Sort by ${t.title.toLowerCase()}`,onclick:()=>this.sort(t.key)},t.title,e?this.wish.descending?" \u25BC":" \u25B2":""))}))}sort(t){let e=this.wish.sort===t;e&&this.wish.descending?this.wish.sort=null:(this.wish.sort=t,this.wish.descending=e),this.wish.sort===null&&(this.wish.descending=!1),this.refresh()}draw(){let{content:t,shown:e}=this.page.store;if(!t||!e.table||this.stale)return;let n=Math.max(0,Math.floor(this.scroll.scrollTop/_s)-Kg),s=Math.min(this.rows.length,Math.ceil((this.scroll.scrollTop+this.scroll.clientHeight)/_s)+Kg),r=[];for(let o=n;o<s;o++)r.push(this.line(t,o));this.rows.length||r.push(y("p",{class:"empty"},this.wish.scope==="selected"?"Nothing is selected.":"No row holds that. Clear the filter to see all.")),Lt(this.body,...r)}line(t,e){let n=this.rows[e],s=y("div",{role:"row",class:"table-row","data-index":e,"aria-rowindex":e+2,"aria-selected":String(this.chosen.has(n))});return s.style.transform=`translateY(${e*_s}px)`,this.all.forEach((r,o)=>{let a=r.of(n),l=y("div",{role:"gridcell",class:r.number?"num":null},o===0&&this.swatch(t,n),r.number&&typeof a=="number"&&Number.isInteger(a)?ge(a):a);typeof a=="string"&&a.length>12&&(l.title=a),de(s,l)}),s}swatch(t,e){if(this.wish.kind==="parts")return Me(ze(t,e).color,t.parts.state[e]);if(this.wish.kind==="lines")return null;let n=t.network.units[e];return Me(t.groups.find(s=>s.unit===n.type)?.color??null,n.kind?"sure":"likely")}mark(t){let{selection:e,place:n}=this.page.store.shown;if(this.wish.kind==="parts")this.chosen=new Set(e);else if(this.wish.kind==="units"){let s=n?t.network.units.findIndex(r=>r.id===n):-1;this.chosen=new Set(s>=0?[s]:e.map(r=>t.parts.unit[r]))}else{let s=new Set(e),r=o=>{let a=ji(t,"lines",o);return a.length>0&&a.every(l=>s.has(l))};this.chosen=new Set(this.rows.filter(o=>s.size>0&&r(o)))}}follow(){let{content:t,shown:e}=this.page.store;if(!t||!e.table)return;if(this.wish.scope==="selected")return this.refresh();this.mark(t);let n=Math.min(...[...this.chosen].map(s=>this.place.get(s)??1/0));Number.isFinite(n)&&!this.clicked&&this.reveal(n),this.draw()}reveal(t){let e=t*_s,n=this.scroll.clientHeight-this.head.offsetHeight;(e<this.scroll.scrollTop||e+_s>this.scroll.scrollTop+n)&&(this.scroll.scrollTop=e-n/2)}rowOf(t){let e=t.target.closest(".table-row");return e?this.rows[Number(e.dataset.index)]:null}click(t){let e=this.rowOf(t);e!==null&&(this.clicked=!0,this.select(e,t.ctrlKey||t.metaKey||t.shiftKey),this.clicked=!1)}select(t,e=!1){let{store:n}=this.page,s=n.content,r=ji(s,this.wish.kind,t);e?n.select([...new Set([...n.shown.selection,...r])]):this.wish.kind==="units"?n.selectPlace(s.network.units[t].id):n.select(r)}fly(t){t!==null&&this.page.view?.flyTo(ji(this.page.store.content,this.wish.kind,t))}key(t){if(t.target!==this.scroll||!this.rows.length)return;let e=Math.min(...[...this.chosen].map(o=>this.place.get(o)??1/0)),n=Number.isFinite(e)?e:-1,s=Math.max(1,Math.floor(this.scroll.clientHeight/_s)-2),r={ArrowDown:n+1,ArrowUp:n-1,PageDown:n+s,PageUp:n-s,Home:0,End:this.rows.length-1}[t.key];if(r!==void 0){let o=Math.max(0,Math.min(this.rows.length-1,r));this.select(this.rows[o]),this.reveal(o)}else if(t.key==="Enter")this.fly(this.rows[n]??null);else return;t.preventDefault(),t.stopPropagation()}save(){let t=(this.page.store.content?.title??"plant").replace(/\.[^.]*$/,"").replace(/[^\w.-]+/g,"_");Jg(`${t}-${this.wish.kind}.csv`,Zg(this.all.map(e=>e.title),this.rows.map(e=>this.all.map(n=>n.of(e))))),this.page.say(`${sd(this.wish.kind,this.rows.length)} saved as CSV.`,"good")}};function jg(i){let t=matchMedia("(prefers-color-scheme: dark)"),e=ws("theme"),n=()=>document.documentElement.dataset.theme=i.shown.theme;i.watch(["theme"],n),i.set({theme:e==="dark"||e==="light"?e:t.matches?"dark":"light"}),n(),t.addEventListener("change",()=>{ws("theme")||i.set({theme:t.matches?"dark":"light"})})}function Qg(i){let t=i.shown.theme==="dark"?"light":"dark";wo("theme",t),i.set({theme:t})}var t0={info:6e3,good:6e3,bad:15e3},oT=15e3,aT=3,fc=class{element=y("div",{class:"toasts","data-test":"toasts"});polite=y("div",{class:"only-read",role:"status","aria-live":"polite"});urgent=y("div",{class:"only-read",role:"alert","aria-live":"assertive"});constructor(t){t.append(this.polite,this.urgent,this.element)}say(t,e="info",n=[]){let s=e==="bad"?this.urgent:this.polite;s.textContent="",requestAnimationFrame(()=>s.textContent=t);let r=y("div",{class:`toast ${e}`,"data-test":"toast"},Tn(e==="good"?"check":e==="bad"?"warn":"dot"),y("span",{class:"toast-text"},t)),o=()=>r.remove();r.append(y("span",{class:"toast-actions"},...n.map(l=>y("button",{type:"button",class:"quiet",onclick:()=>{o(),l.run()}},l.text)))),r.append(y("button",{type:"button",class:"icon-button","aria-label":"Dismiss",title:"Dismiss",onclick:o},Tn("close")));for(let l of[...this.element.children])(e==="good"&&l.classList.contains("good")||l.querySelector(".toast-text")?.textContent===t)&&l.remove();for(this.element.append(r);this.element.children.length>aT;)this.element.firstElementChild.remove();let a=setTimeout(o,n.length>1?Math.max(t0[e],oT):t0[e]);for(let l of["pointerenter","focusin"])r.addEventListener(l,()=>clearTimeout(a));for(let l of["pointerleave","focusout"])r.addEventListener(l,()=>{clearTimeout(a),a=setTimeout(o,4e3)})}};var pc=class{element;search;page;title=y("h1",{class:"plant-title","data-test":"title"});undo=qe("undo","Undo",()=>zn("undo"),"undo");redo=qe("redo","Redo",()=>zn("redo"),"redo");review=y("button",{type:"button",class:"chip","data-test":"review-count",title:"What is most worth a look first (r)",onclick:()=>zn("review")},"Review");edits=y("button",{type:"button",class:"chip","data-test":"edit-count",title:"What was corrected",onclick:()=>zn("history")});badge=y("button",{type:"button",class:"read-only","data-test":"read-only",hidden:!0,onclick:()=>this.page.say(this.page.store.state?.read_only??"","bad")});theme=qe("moon","Dark",()=>Qg(this.page.store),"theme");table=e0("table","Table","Table of parts, units and lines (b)","table");drawing=e0("schematic","Schematic","The schematic beside the plant (d)","drawing");constructor(t,e){this.page=t;let{element:n,input:s}=this.quickSearch(e);this.search=s;let r=t.source.live?[y("div",{class:"group",role:"group","aria-label":"Corrections"},this.undo,this.redo),this.review,this.edits]:[];for(let[o,a]of[[this.table,"table"],[this.drawing,"schematic"]])o.addEventListener("click",()=>t.store.set({[a]:!t.store.shown[a]}));this.element=y("header",{class:"top"},y("span",{class:"brand"},"cadgraph"),this.title,n,...r,this.badge,y("span",{class:"grow"}),y("div",{class:"group",role:"group","aria-label":"Panes"},this.drawing,this.table),y("div",{class:"group"},qe("link","Link to this view (k)",()=>zn("link"),"link"),this.theme,qe("help","Keys and mouse (?)",()=>zn("help"),"help-button"))),t.store.on("state",()=>this.update()),t.store.watch(["theme","table","schematic"],()=>this.marks()),this.marks()}quickSearch(t){let e=()=>{n.input.blur()},n=rd(this.page,"search",{units:6,lines:4,parts:6},e,r=>{e(),t(r)});n.list.classList.add("drop");let s=y("div",{class:"search",role:"search"},Tn("search"),n.input,n.list);return n.list.hidden=!0,n.input.addEventListener("focus",()=>{n.list.hidden=!1,n.search(n.input.value)}),n.input.addEventListener("blur",()=>n.list.hidden=!0),{element:s,input:n.input}}setLeft(t){Lt(this.review,t===""?"Review":t==="0"?"Reviewed":`Review ${t}`)}update(){let{state:t}=this.page.store;if(!t)return;document.title=`${t.title||"cadgraph"} \u2013 cadgraph`,Lt(this.title,t.title),this.title.title=[t.title,t.folder&&`folder ${t.folder}`,t.who&&`you are ${t.who}`].filter(Boolean).join(", ");for(let[n,s,r,o]of[[this.undo,"Undo",t.can_undo,t.undo],[this.redo,"Redo",t.can_redo,t.redo]])n.disabled=!r||!this.page.canEdit(),n.title=o?`${s}: ${o}`:`Nothing to ${s.toLowerCase()}`,n.setAttribute("aria-label",n.title);Lt(this.edits,ee(t.n_edits,"correction"),t.lost.length>0&&y("span",{class:"badge bad"},`${t.lost.length} lost`)),this.edits.title=t.lost.length?`${ee(t.lost.length,"correction")} no longer fit this model: see History`:"What was corrected, and by whom",this.badge.hidden=!t.read_only;let e=t.away?"No server":"View only";Lt(this.badge,e),this.badge.title=t.read_only??"",this.badge.setAttribute("aria-label",`${e}: ${t.read_only??""}`)}marks(){let{theme:t,table:e,schematic:n}=this.page.store.shown;Lt(this.theme,Tn(t==="dark"?"sun":"moon")),this.theme.title=t==="dark"?"Light colours":"Dark colours",this.theme.setAttribute("aria-label",this.theme.title),this.table.setAttribute("aria-pressed",String(e)),this.drawing.setAttribute("aria-pressed",String(n))}};function e0(i,t,e,n){return y("button",{type:"button",title:e,"aria-label":t,"data-test":`${i}-toggle`},Tn(n),y("span",{class:"wide-only"},t))}var lT=new Set(["unit-short-of-lines"]),dd=["ground","excluded","duplicate-mesh","near-duplicate-mesh","empty-mesh","open-mesh","likely"];function cT(i){let t=new Map,e=(s,r,o)=>{let a=t.get(s);a?a.items.push(o):t.set(s,{key:s,title:r,items:[o]})};for(let s of Xl(i))e(s.kind,qm[s.kind],{text:s.title,detail:s.text,place:s.place,parts:s.parts});for(let{code:s,message:r,parts:o}of i.diagnostics){if(lT.has(s))continue;if(!((s==="unlabelled"||s==="likely")&&o.length>1))e(s,ju(s),{text:r,detail:"",place:null,parts:o});else for(let l of o)e(s,ju(s),{text:bs(i,l),detail:"",note:or(i,l),place:null,parts:[l]})}let n=s=>dd.indexOf(s.key);return[...t.values()].sort((s,r)=>n(s)-n(r))}var ud=60,mc=class{element=y("div",{class:"warnings","data-test":"warnings"});page;changed;at=new Map;open=new Set;stale=!0;known=null;constructor(t,e){this.page=t,this.changed=e,t.store.on("content",n=>{this.stale=!0,this.changed(this.groups(n).filter(s=>!dd.includes(s.key)).reduce((s,r)=>s+r.items.length,0)),this.draw()}),t.store.watch(["leftTab"],()=>this.draw())}groups(t){return this.known?.content!==t&&(this.known={content:t,groups:cT(t)}),this.known.groups}draw(){let{content:t,shown:e}=this.page.store;if(!t||!this.stale||e.leftTab!=="warnings")return;this.stale=!1;let n=this.groups(t);if(!n.length){Lt(this.element,y("p",{class:"empty"},"No warnings: every unit has the lines it needs, and every part a label."));return}let s=n.some(r=>!dd.includes(r.key));Lt(this.element,y("p",{class:"soft lead"},s?"Click one to see it in its place; the arrows go through them one by one.":"Nothing is wrong; these are only to be known."),...n.map(r=>this.group(r)))}group(t){let e=t.items.length,n=y("span",{class:"number","aria-live":"polite"}),s=y("ul",{class:"rows"}),r=a=>this.go(t,((this.at.get(t.key)??(a>0?-1:0))+a+e)%e,s,n),o=y("details",{class:"fold warning-group",open:this.open.has(t.key)||t.items.length<=4,"data-test":"warning-group","data-code":t.key},y("summary",{},y("span",{class:"grow"},t.title),y("span",{class:"badge"},ge(e))),e>1&&y("div",{class:"spread stepper"},qe("left","The one before",()=>r(-1)),n,qe("right","The next one",()=>r(1),"warning-next"),gn("Select all","Select the parts of all of them",()=>this.page.store.select([...new Set(t.items.flatMap(a=>a.parts))]))),s);return o.addEventListener("toggle",()=>o.open?this.open.add(t.key):this.open.delete(t.key)),t.items.slice(0,ud).forEach((a,l)=>de(s,y("li",{},y("button",{type:"button",class:"row wrap","data-test":"warning",disabled:!a.parts.length&&!a.place,onclick:()=>this.go(t,l,s,n)},y("span",{class:"grow"},a.text),a.note&&y("span",{class:"soft"},a.note))))),e>ud&&de(s,y("li",{class:"soft"},`and ${ee(e-ud,"more","more")}: the arrows reach them all`)),n.textContent=`${e}`,o}go(t,e,n,s){this.at.set(t.key,e),s.textContent=`${e+1} of ${t.items.length}`,n.querySelector("[aria-current]")?.removeAttribute("aria-current");let r=n.children[e]?.querySelector("button.row");r?.setAttribute("aria-current","true"),r?.scrollIntoView({block:"nearest"});let o=t.items[e];n.querySelector(".detail")?.remove();let a=o.detail?y("p",{class:"soft detail",role:"status"},o.detail):null;r&&de(r.parentElement,a),this.page.go(o.parts,o.place)}};function n0(i,t,e){jg(t);let n=new fc(i),s=(x,_,A)=>n.say(x,_,A),r=new ic(t,e,s);t.on("gone",x=>s(`${x} is no more: nothing is selected now.`));let o=y("div",{class:"pick-hint",role:"status","data-test":"pick-hint",hidden:!0}),a=new fd(t,o),l={store:t,source:e,view:null,say:s,canEdit:()=>e.live&&t.state?.status==="ready"&&!t.state.read_only,edit:(x,_)=>r.edit(x,_),refusal:()=>r.refusal,undo:async()=>{await r.undo()},redo:async()=>{await r.redo()},go:(x,_=null)=>{t.select(x,_),x.length&&l.view?.flyTo(x)},pickNext:(x,_)=>a.start(x,_),pickLabel:(x,_,A)=>t.content&&$g(t.content,x,_,A)},c=y("div",{class:"network-tab"}),h=new lc(l),u=new rc(l),d=new uc(l,r,()=>p.setLeft(d.left),()=>m.isOpen("left")),f=new mc(l,x=>{let{badge:_}=m.tabs.get("warnings");Lt(_,ge(x)),_.hidden=x===0}),p=new pc(l,x=>{S("find"),u.open(x)}),b={review:d.element,find:u.element,network:c,warnings:f.element,history:new oc(l).element},m=Wg(t,p.element,h.element,new dc(l).element,b),g=new nc;i.prepend(m.root,g.element),m.middle.append(o,g.strip,n.element);let w=new ec(l);function S(x){m.toggle("left",!0),t.set({leftTab:x})}if(!e.live)for(let x of["review","history"])m.tabs.get(x).button.hidden=!0;return uT(l,{picking:a,layout:m,address:w,open:S,find:()=>p.search.focus()}),{middle:m.middle,schematicPane:m.schematicPane,networkSlot:h.networkSlot,networkTab:c,edit:l.edit,say:s,untilReady:async()=>{await hT(t,e,r,g,s),e.live||m.middle.append(y("p",{class:"view-only","data-test":"view-only"},"View only: corrections are made with 'cadgraph view'.")),w.start(),!e.live&&["review","history"].includes(t.shown.leftTab)&&t.set({leftTab:"find"})},followLine:x=>h.lineNow=x,connect:x=>{l.view=x;let{camera:_}=t.shown;_?x.setCamera(_):d.viewed()}}}async function hT(i,t,e,n,s){if(!t.live){i.setState(await t.state()),i.setContent(await t.content());return}let r="",o;await new Promise(a=>{let l=null,c=u=>{i.setContent(u),n.show(i.state,!0),a()},h=u=>{i.content?u!==r&&s(u,"bad"):n.show(i.state,!1,u),r=u,e.lost(),i.state&&i.setState({...i.state,read_only:u,away:!0})};t.follow(new AbortController().signal,u=>{r&&i.content&&s("The server answers again.","good"),r="",u.read_only&&o!==void 0&&u.read_only!==o&&s(u.read_only,"bad"),o=u.read_only,e.heard(u),n.show(i.state,!!i.content),!(i.content||u.status==="failed"||u.status==="building"&&u.version<1)&&(l??=t.content().then(c,d=>{l=null,d instanceof bn&&d.status===423||h(d.message)}))},h)})}var fd=class{store;hint;stop=null;constructor(t,e){this.store=t,this.hint=e}get active(){return this.stop!==null}start(t,e){this.end(),Lt(this.hint,y("span",{},t),y("button",{type:"button",class:"quiet",onclick:()=>this.end()},"Cancel (Esc)")),this.hint.hidden=!1;let n=this.store.watch(["selection","place"],()=>{let{selection:s}=this.store.shown;s.length&&(this.end(),e(s.at(-1)))});this.stop=n}end(){this.stop?.(),this.stop=null,this.hint.hidden=!0}};function uT(i,{picking:t,layout:e,address:n,open:s,find:r}){let{store:o,source:a}=i,l=()=>a.live,c=u=>{i.canEdit()?u():i.say(o.state?.read_only??"The plant is still being made ready for corrections.","bad")},h={title:"Redo",area:"Corrections",run:()=>c(()=>o.state?.can_redo?void i.redo():i.say("Nothing to do again."))};ii({id:"pick-cancel",key:"Escape",title:"Cancel what is going on",area:"Selection",when:()=>t.active,run:()=>t.end()},{id:"find",key:"/",title:"Find",area:"Selection",run:r},{id:"table",key:"b",title:"Table of parts, units and lines",area:"View",run:()=>o.set({table:!o.shown.table})},{id:"fold-left",key:"[",title:"Left panel",area:"View",run:()=>e.toggle("left")},{id:"fold-right",key:"]",title:"Inspector",area:"View",run:()=>e.toggle("right")},{id:"link",key:"k",title:"Link to this view, and going to one",area:"View",run:()=>n.open()},{id:"help",key:"?",title:"This list",area:"Help",run:xg}),l()&&ii({id:"review",key:"r",title:"Review: what is most worth a look",area:"Review",run:()=>s("review")},{id:"history",title:"History",area:"Corrections",run:()=>s("history")},{id:"label",key:"l",title:"Label what is selected",area:"Corrections",when:()=>o.shown.selection.length>0,run:()=>c(()=>dT(i))},{id:"undo",key:"Ctrl+z",title:"Undo",area:"Corrections",run:()=>c(()=>o.state?.can_undo?void i.undo():i.say("Nothing to undo."))},{id:"redo",key:"Ctrl+y",...h},{id:"redo-shift",key:"Ctrl+Z",...h})}function dT(i){let t=i.store.content,e=i.store.shown.selection,n=e.length===1?`What is this ${ze(t,e[0]).name.toLowerCase()}?`:`What are these ${ge(e.length)} parts?`,s=e.length===1?t.parts.guesses[e[0]].flatMap(([r,o])=>t.groups[r]?[{group:t.groups[r].name,name:o}]:[]):[];i.pickLabel(n,s,r=>{i.edit(e.map(o=>({kind:"label",part:t.parts.id[o],...r,this_only:e.length>1||Ng(o)})))})}var fT=5,gc=class{down=new Map;start={x:0,y:0,moved:!1};pivot=new P;spread=0;element;navigation;target;wheelPoint=null;constructor(t,e,n){this.element=t,this.navigation=e,this.target=n,t.addEventListener("pointerdown",s=>this.press(s)),t.addEventListener("pointermove",s=>this.move(s)),t.addEventListener("pointerup",s=>this.release(s)),t.addEventListener("pointercancel",s=>this.down.delete(s.pointerId)),t.addEventListener("pointerleave",()=>n.left()),t.addEventListener("wheel",s=>this.wheel(s),{passive:!1}),t.addEventListener("dblclick",s=>n.doubleClicked(...this.at(s))),t.addEventListener("contextmenu",s=>s.preventDefault())}at(t){let e=this.element.getBoundingClientRect();return[t.clientX-e.left,t.clientY-e.top]}press(t){let[e,n]=this.at(t);this.element.setPointerCapture(t.pointerId),this.down.set(t.pointerId,{x:e,y:n}),this.down.size===1?(this.start={x:e,y:n,moved:!1},this.pivot=this.target.pointAt(e,n)):(this.start.moved=!0,this.spread=this.fingers().spread)}move(t){let[e,n]=this.at(t),s=this.down.get(t.pointerId);if(!s){this.target.hovered(e,n);return}let r=this.down.size>1?this.fingers():null,[o,a]=[e-s.x,n-s.y];if(this.down.set(t.pointerId,{x:e,y:n}),!this.start.moved&&Math.hypot(e-this.start.x,n-this.start.y)<fT)return;this.start.moved=!0;let l=this.element.clientHeight;if(r){let c=this.fingers();this.navigation.pan(this.pivot,c.x-r.x,c.y-r.y,l),c.spread>1&&this.spread>1&&this.navigation.zoom(this.pivot,this.spread/c.spread),this.spread=c.spread}else t.buttons&1&&!t.shiftKey?this.navigation.orbit(this.pivot,o/l*Math.PI*1.2,a/l*Math.PI*1.2):this.navigation.pan(this.pivot,o,a,l)}release(t){this.down.delete(t.pointerId)&&!this.start.moved&&t.button===0&&this.down.size===0&&this.target.clicked(...this.at(t),t)}wheel(t){t.preventDefault();let[e,n]=this.at(t),s=performance.now(),r=this.wheelPoint,a=r&&Math.hypot(e-r.x,n-r.y)<3&&s-r.at<400?r.point:this.target.pointAt(e,n);this.wheelPoint={x:e,y:n,at:s,point:a};let l=t.deltaMode===1?16:t.deltaMode===2?400:1;this.navigation.zoom(a,Math.exp(Math.max(-300,Math.min(300,t.deltaY*l))*.0012))}fingers(){let[t,e]=[...this.down.values()];return{x:(t.x+e.x)/2,y:(t.y+e.y)/2,spread:Math.hypot(t.x-e.x,t.y-e.y)}}};var xn={ghost:1,hatched:2,selected:4,alike:16,marked:32},_o=8,i0=`
#include <common>
#include <batching_pars_vertex>
attribute vec2 oct;
uniform highp sampler2D stateTexture;
uniform int ghosts;
flat varying vec4 vState;
flat varying vec3 vMesh;
varying vec3 vNormal;
varying vec3 vWorld;

vec3 unfold(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

void main() {
  float instance = getIndirectIndex(gl_DrawID);
  int width = textureSize(stateTexture, 0).x;
  int at = 2 * int(instance);
  vState = texelFetch(stateTexture, ivec2(at % width, at / width), 0);
  vMesh = texelFetch(stateTexture, ivec2((at + 1) % width, (at + 1) / width), 0).rgb;
  bool ghost = (int(vState.a * 255.0 + 0.5) & 1) != 0;
  if (ghost != (ghosts == 1)) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  mat4 place = getBatchingMatrix(instance);
  vec4 world = place * vec4(position, 1.0);
  mat3 turn = mat3(normalize(place[0].xyz), normalize(place[1].xyz), normalize(place[2].xyz));
  vNormal = turn * unfold(max(oct / 127.0, -1.0));
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`,pd=`
// A program that may discard pixels must shade those behind others, too: only where something is cut.
#ifdef CUTTING
uniform vec4 section;
#endif
`,s0=`
layout(location = 0) out vec4 outColor;
layout(location = 1) out vec4 outNormal;
layout(location = 2) out vec4 outMesh;
flat in vec4 vState;
flat in vec3 vMesh;
in vec3 vNormal;
in vec3 vWorld;
uniform vec3 toLight;
uniform vec3 lookDirection;
uniform bool parallel;
uniform vec3 accent;
uniform vec3 markColor;
${pd}
// Close enough to sRGB, and much cheaper.
vec3 linear(vec3 c) { return c * c; }
vec3 shown(vec3 c) { return sqrt(clamp(c, 0.0, 1.0)); }

void main() {
#ifdef CUTTING
  if (dot(section.xyz, vWorld) > section.w) discard;
#endif
  int flags = int(vState.a * 255.0 + 0.5);
  vec3 toEye = parallel ? -lookDirection : normalize(cameraPosition - vWorld);
  vec3 n = normalize(vNormal);
  if (dot(n, toEye) < 0.0) n = -n;
  vec3 base = linear(vState.rgb);
  float stripe = step(0.5, fract((gl_FragCoord.x + gl_FragCoord.y) / 9.0));
  if ((flags & ${xn.hatched}) != 0) base = mix(base, base * 0.62 + 0.02, stripe);
  if ((flags & ${xn.marked}) != 0) base = linear(markColor);
  if ((flags & ${xn.alike}) != 0) base = mix(base, linear(accent), 0.5 * stripe + 0.1);
  if ((flags & ${xn.selected}) != 0) base = mix(base, linear(accent), 0.55);
  bool cap = false;
#ifdef CUTTING
  cap = !gl_FrontFacing;
  if (cap) n = section.xyz;
#endif
  float sky = 0.5 + 0.5 * n.z;
  float key = max(dot(n, toLight), 0.0);
  float facing = max(dot(n, toEye), 0.0);
  float rim = (1.0 - facing) * (1.0 - facing) * (1.0 - facing);
  vec3 light = mix(vec3(0.30, 0.29, 0.28), vec3(0.62, 0.65, 0.70), sky) + 0.46 * key + 0.10 * facing;
  vec3 color = cap ? base * 0.7 : base * light + 0.03 * rim;
  outColor = vec4(shown(color), 1.0);
  vec3 seen = (viewMatrix * vec4(n, 0.0)).xyz;
  outNormal = vec4(seen.xy * 0.5 + 0.5, vState.a, 1.0);
  outMesh = vec4(vMesh, 1.0);
}`,r0=`
layout(location = 0) out vec4 outColor;
flat in vec4 vState;
flat in vec3 vMesh;
in vec3 vNormal;
in vec3 vWorld;
uniform vec3 lookDirection;
uniform bool parallel;
uniform float faint;
${pd}
void main() {
#ifdef CUTTING
  if (dot(section.xyz, vWorld) > section.w) discard;
#endif
  vec3 toEye = parallel ? -lookDirection : normalize(cameraPosition - vWorld);
  float facing = abs(dot(normalize(vNormal), toEye));
  float alpha = faint * (0.35 + 0.65 * pow(1.0 - facing, 2.0));
  outColor = vec4(mix(vState.rgb, vec3(0.55, 0.6, 0.66), 0.7) * alpha, alpha);
}`,o0=`
varying vec3 vWorld;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`,a0=`
layout(location = 0) out vec4 outColor;
in vec3 vWorld;
${pd}
void main() {
#ifdef CUTTING
  if (dot(section.xyz, vWorld) > section.w) discard;
#endif
  outColor = vec4(1.0);
}`,l0=`
varying vec2 vUv;
void main() {
  vUv = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`,c0=`
layout(location = 0) out vec4 outColor;
in vec2 vUv;
uniform sampler2D tColor, tNormal, tMesh, tGhost, tMask;
uniform highp sampler2D tDepth;
uniform vec2 texel;
uniform vec2 used;
uniform vec4 lens;
uniform bool occlusion, hasGhosts, hasMask, parallel;
uniform float weight, turn, edgeStrength;
uniform vec3 skyTop, skyBottom, ink, accent;

// Before the eye; lens: half width and height of the picture at distance 1 (or anywhere), and what depth means there.
vec3 placeAt(vec2 uv) {
  float d = texture(tDepth, uv).r;
  vec2 xy = (uv / used * 2.0 - 1.0) * lens.xy;
  if (parallel) return vec3(xy, lens.z + lens.w * d);
  float z = lens.z / (d + lens.w);
  return vec3(xy * -z, z);
}
vec3 normalAt(vec2 uv) {
  vec2 xy = texture(tNormal, uv).xy * 2.0 - 1.0;
  return vec3(xy, sqrt(max(0.0, 1.0 - dot(xy, xy))));
}
int flagsAt(vec2 uv) { return int(texture(tNormal, uv).z * 255.0 + 0.5); }

// Lines where parts, creases and silhouettes end, on the nearer side.
float edgeAt(vec2 uv, vec3 p, vec3 n, vec3 mesh) {
  float found = 0.0;
  float pixel = length(placeAt(uv + vec2(texel.x, 0.0)) - p);
  for (int k = 0; k < 4; k++) {
    vec2 way = k == 0 ? vec2(1, 0) : k == 1 ? vec2(-1, 0) : k == 2 ? vec2(0, 1) : vec2(0, -1);
    vec2 at = uv + way * texel;
    vec4 other = texture(tMesh, at);
    if (other.a == 0.0) { found = max(found, 0.85); continue; }
    vec3 q = placeAt(at);
    float away = abs(dot(q - p, n));
    bool nearer = p.z >= q.z;
    float far = max(abs(p.z) * 0.004, 3.0 * length(q.xy - p.xy));
    if (nearer && away > far) found = max(found, 0.8);
    else if (other.rgb != mesh && nearer) found = max(found, 0.5);
    else if (dot(normalAt(at), n) < 0.83 && nearer) found = max(found, 0.42);
  }
  return found;
}

float occluded(vec2 uv, vec3 p, vec3 n) {
  float sum = 0.0;
  float reach = max(0.01 * abs(p.z), 0.02);
  for (int k = 0; k < 8; k++) {
    float angle = turn + float(k) * 2.399963;
    float radius = (float(k) + 0.5) / 8.0;
    vec2 at = uv + vec2(cos(angle), sin(angle)) * texel * mix(2.0, 26.0, radius);
    if (at.x < 0.0 || at.y < 0.0 || at.x > used.x || at.y > used.y || texture(tMesh, at).a == 0.0) continue;
    vec3 v = placeAt(at) - p;
    float d = length(v);
    sum += max(0.0, dot(n, v) / max(d, 1e-6) - 0.12) * smoothstep(reach * 2.0, reach * 0.3, d);
  }
  return clamp(1.0 - 0.22 * sum, 0.35, 1.0);
}

void main() {
  vec2 uv = vUv * used;
  vec4 mesh = texture(tMesh, uv);
  vec3 color = mix(skyBottom, skyTop, vUv.y);
  int flags = 0;
  if (mesh.a > 0.0) {
    flags = flagsAt(uv);
    vec3 p = placeAt(uv);
    vec3 n = normalAt(uv);
    color = texture(tColor, uv).rgb;
    if (occlusion) color *= mix(occluded(uv, p, n), 1.0, 0.25);
    color = mix(color, ink, edgeStrength * edgeAt(uv, p, n, mesh.rgb));
  }
  if (hasGhosts) {
    vec4 ghost = texture(tGhost, uv);
    color = color * (1.0 - ghost.a) + ghost.rgb;
  }
  if (hasMask) {
    float here = texture(tMask, uv).r;
    float least = here, most = here;
    for (int k = 0; k < 8; k++) {
      float angle = float(k) * 0.785398;
      float other = texture(tMask, uv + vec2(cos(angle), sin(angle)) * texel * 1.2).r;
      least = min(least, other);
      most = max(most, other);
    }
    bool seen = (flags & 4) != 0;
    if (here > 0.5 && !seen) color = mix(color, accent, 0.28);
    if (most - least > 0.5) color = mix(color, accent, seen || here < 0.5 ? 0.95 : 0.6);
    else if (here < 0.5) {
      // A dark rim, as no one colour stands out from all others.
      float around = 0.0;
      for (int k = 0; k < 8; k++) {
        float angle = float(k) * 0.785398;
        around = max(around, texture(tMask, uv + vec2(cos(angle), sin(angle)) * texel * 2.4).r);
      }
      if (around > 0.5) color = mix(color, vec3(0.06, 0.08, 0.11), 0.8);
    }
  }
  outColor = vec4(color, weight);
}`,h0=`
layout(location = 0) out vec4 outColor;
in vec2 vUv;
uniform sampler2D tPicture, tMesh;
uniform highp sampler2D tDepth;
uniform vec2 used;
uniform vec3 hovered[${_o}];
uniform int nHovered;
void main() {
  vec3 color = texture(tPicture, vUv * used).rgb;
  if (nHovered > 0) {
    vec4 mesh = texture(tMesh, vUv * used);
    for (int k = 0; k < ${_o}; k++)
      if (k < nHovered && mesh.a > 0.0 && distance(mesh.rgb, hovered[k]) < 0.001) color = mix(color, vec3(1.0), 0.22);
  }
  outColor = vec4(color, 1.0);
  gl_FragDepth = texture(tDepth, vUv * used).r;
}`,u0=`
layout(location = 0) out vec4 outColor;
in vec2 vUv;
uniform highp sampler2D tDepth;
uniform vec2 used;
void main() {
  float d = min(texture(tDepth, vUv * used).r, 0.9999999) * 16777215.0;
  outColor = vec4(mod(d, 256.0), mod(floor(d / 256.0), 256.0), floor(d / 65536.0), 255.0) / 255.0;
}`;var xc=class{renderer;plant=new ci;mask=new ci;overlay=new ci;overlayOnTop=new ci;material;maskMaterial;ghostMaterial;composeMaterial;showMaterial;screen;flat=new Kn(-1,1,1,-1,0,1);targets;used=new Et(1,1);size=new Et(1,1);clearColor=new Ot(0,0,0);constructor(t,e){this.renderer=new Ul({canvas:t,antialias:e,powerPreference:"high-performance",alpha:!1}),this.renderer.autoClear=!1,this.renderer.info.autoReset=!1;let n={stateTexture:{value:null},section:{value:new Wt},toLight:{value:new P(0,0,1)},lookDirection:{value:new P(0,1,0)},parallel:{value:!1},accent:{value:new Ot},markColor:{value:new Ot}},s=(r,o,a={})=>new hn({glslVersion:gs,vertexShader:i0,fragmentShader:r,uniforms:{...n,...o},side:Oe,blending:Qn,defines:{},...a});this.material=s(s0,{ghosts:{value:0}}),this.ghostMaterial=s(r0,{ghosts:{value:1},faint:{value:.3}},{transparent:!0,depthWrite:!1,blending:to,blendSrc:Ja,blendDst:Qs}),this.maskMaterial=new hn({glslVersion:gs,vertexShader:o0,fragmentShader:a0,side:Oe,depthTest:!1,depthWrite:!1,blending:Qn,uniforms:{section:n.section},defines:{}}),this.composeMaterial=vc(c0,{tColor:{value:null},tNormal:{value:null},tMesh:{value:null},tGhost:{value:null},tMask:{value:null},tDepth:{value:null},texel:{value:new Et},used:{value:new Et},lens:{value:new Wt},parallel:{value:!1},occlusion:{value:!1},hasGhosts:{value:!1},hasMask:{value:!1},weight:{value:1},turn:{value:0},edgeStrength:{value:.8},skyTop:{value:new Ot},skyBottom:{value:new Ot},ink:{value:new Ot},accent:{value:new Ot}},{blending:to,blendSrc:eo,blendDst:Qs,transparent:!0,depthTest:!1,depthWrite:!1}),this.showMaterial=vc(h0,{tPicture:{value:null},tMesh:{value:null},tDepth:{value:null},used:{value:new Et},hovered:{value:Array.from({length:_o},()=>new P)},nHovered:{value:0}},{blending:Qn}),this.screen=new Ie(new Ai(2,2),this.composeMaterial),this.screen.frustumCulled=!1,this.targets=f0(1,1);for(let r of[this.plant,this.mask])r.matrixAutoUpdate=!1}setPalette(t){let{composeMaterial:e,material:n}=this,s=(r,o)=>r.value.setStyle(o,"");s(e.uniforms.skyTop,t.top),s(e.uniforms.skyBottom,t.bottom),s(e.uniforms.ink,t.ink),s(e.uniforms.accent,t.accent),s(n.uniforms.accent,t.accent),s(n.uniforms.markColor,t.mark)}setSize(t,e,n,s){this.renderer.setPixelRatio(1),this.renderer.setSize(t,e,!1);let r=this.renderer.domElement;r.style.width=`${n}px`,r.style.height=`${s}px`,this.size.set(t,e),p0(this.targets),this.targets=f0(t,e)}setHovered(t){let{hovered:e,nHovered:n}=this.showMaterial.uniforms;n.value=Math.min(t.length,_o);for(let s=0;s<n.value;s++){let r=t[s]+1;e.value[s].set(r&255,r>>8&255,r>>16&255).divideScalar(255)}}setSection(t){this.material.uniforms.section.value.copy(t??new Wt(0,0,0,0));for(let e of[this.material,this.ghostMaterial,this.maskMaterial])"CUTTING"in e.defines!=(t!==null)&&(e.defines=t?{CUTTING:1}:{},e.needsUpdate=!0)}draw(t,e){let{renderer:n,targets:s}=this,r=Math.max(1,Math.round(this.size.x*e.scale)),o=Math.max(1,Math.round(this.size.y*e.scale));this.used.set(r/this.size.x,o/this.size.y),n.info.reset(),this.lookFrom(t);let a=d0[e.sample%d0.length];t.setViewOffset(r,o,a[0],a[1],r,o),t.updateProjectionMatrix();for(let c of[s.pixels,s.ghosts,s.mask,s.sum])c.viewport.set(0,0,r,o),c.scissor.set(0,0,r,o),c.scissorTest=!0;n.setClearColor(this.clearColor,0),this.plant.overrideMaterial=null,n.setRenderTarget(s.pixels),n.clear(),n.render(this.plant,t),e.ghosts&&(this.plant.overrideMaterial=this.ghostMaterial,n.setRenderTarget(s.ghosts),n.clear(!0,!1,!1),n.render(this.plant,t),this.plant.overrideMaterial=null);let l=this.mask.children.length>0;l&&(n.setRenderTarget(s.mask),n.clear(),n.render(this.mask,t)),this.compose(t,e,l),t.clearViewOffset(),t.updateProjectionMatrix(),this.show()}lookFrom(t){let{uniforms:e}=this.material,n=t.getWorldDirection(e.lookDirection.value);e.parallel.value=this.ghostMaterial.uniforms.parallel.value="isOrthographicCamera"in t;let s=e.toLight.value,r=new P().crossVectors(n,t.up).normalize();s.copy(n).multiplyScalar(-.55).addScaledVector(r,-.5),s.z=Math.max(s.z,0)+.75,s.normalize()}compose(t,e,n){let{renderer:s,targets:r}=this,{uniforms:o}=this.composeMaterial;o.tColor.value=r.pixels.textures[0],o.tNormal.value=r.pixels.textures[1],o.tMesh.value=r.pixels.textures[2],o.tDepth.value=r.pixels.depthTexture,o.tGhost.value=r.ghosts.texture,o.tMask.value=r.mask.texture,o.texel.value.set(1/this.size.x,1/this.size.y),o.used.value.copy(this.used),o.parallel.value="isOrthographicCamera"in t,pT(o.lens.value,t),o.occlusion.value=e.occlusion,o.hasGhosts.value=e.ghosts,o.hasMask.value=n,o.weight.value=1/(e.sample+1),o.turn.value=e.sample*1.1,this.screen.material=this.composeMaterial,s.setRenderTarget(r.sum),e.sample===0&&s.clear(),s.render(this.screen,this.flat)}show(t){let{renderer:e,targets:n}=this,{uniforms:s}=this.showMaterial;s.tPicture.value=n.sum.texture,s.tMesh.value=n.pixels.textures[2],s.tDepth.value=n.pixels.depthTexture,s.used.value.copy(this.used),this.screen.material=this.showMaterial,e.setRenderTarget(null),e.clear(),e.render(this.screen,this.flat),t&&this.drawOverlays(t)}drawOverlays(t){let{renderer:e}=this;e.setRenderTarget(null),this.overlay.children.length&&e.render(this.overlay,t),this.overlayOnTop.children.length&&(e.clearDepth(),e.render(this.overlayOnTop,t))}meshAt(t,e){let n=this.size.x*this.used.x,s=this.size.y*this.used.y,r=new Uint8Array(4),o=Math.min(n-1,Math.max(0,Math.floor(t*n))),a=Math.min(s-1,Math.max(0,Math.floor((1-e)*s)));return this.renderer.readRenderTargetPixels(this.targets.pixels,o,a,1,1,r,void 0,2),r[3]?r[0]+256*r[1]+65536*r[2]-1:-1}get depth(){return{texture:this.targets.pixels.depthTexture,used:this.used}}add(t,e){(e?this.overlayOnTop:this.overlay).add(t)}dispose(){p0(this.targets),this.renderer.dispose()}},d0=[[0,0],[-.25,.17],[.25,-.17],[-.38,-.33],[.13,.39],[-.13,-.06],[.38,.28],[.06,-.44],[-.44,.06],[.31,.07],[-.19,.41],[.19,-.3],[-.31,-.19],[.44,-.41],[-.03,.22],[.03,.02]];function f0(i,t){let e=new Jn(i,t,Mn),n={minFilter:Se,magFilter:Se,format:je,type:en,generateMipmaps:!1};return{pixels:new Re(i,t,{...n,count:3,depthTexture:e}),ghosts:new Re(i,t,{...n,depthTexture:e}),mask:new Re(i,t,{...n,depthBuffer:!1}),sum:new Re(i,t,{...n,type:kn,minFilter:Xe,magFilter:Xe,depthBuffer:!1})}}function pT(i,t){let{near:e,far:n}=t;t instanceof Kn?i.set(t.right,t.top,-e,e-n):i.set(1/t.projectionMatrix.elements[0],1/t.projectionMatrix.elements[5],e*n/(n-e),-n/(n-e))}function p0(i){for(let t of Object.values(i))t.dispose();i.pixels.depthTexture?.dispose()}function vc(i,t,e={}){return new hn({glslVersion:gs,vertexShader:l0,fragmentShader:i,uniforms:t,...e})}var pi={none:0,coarse:1,full:2},md=48,mT=24,yc=class{drawn;pixels;triangles=0;meshes=0;coarse;full;plant;frustum=new hi;matrix=new Mt;ball=new Pn;eye=new P;ahead=new P;constructor(t){this.plant=t,this.drawn=new Uint8Array(t.n),this.pixels=new Float32Array(t.n);let e=()=>({batch:new Array(t.n).fill(null),instance:new Uint32Array(t.n),triangles:new Uint32Array(t.n)});this.coarse=e(),this.full=e()}add(t){let e=t.level===0?this.full:this.coarse;t.meshes.forEach((n,s)=>{e.batch[n]=t,e.instance[n]=s,e.triangles[n]=t.triangles[s]})}remove(t){let e=t.level===0?this.full:this.coarse;t.meshes.forEach(n=>{e.batch[n]===t&&(this.drawn[n]===(t.level===0?pi.full:pi.coarse)&&(this.drawn[n]=pi.none),e.batch[n]=null)})}formOf(t){for(let e of[this.full,this.coarse]){let n=e.batch[t];if(n)return{batch:n,instance:e.instance[t]}}return null}eachForm(t,e){for(let n of[this.full,this.coarse]){let s=n.batch[t];s&&e(s,n.instance[t])}}look(t,e,n,s,r){this.measure(t,e,n);let{plant:o,pixels:a,coarse:l,full:c}=this,h=new Float64Array(md);for(let p=0;p<o.n;p++)a[p]>=s&&(h[m0(a[p])]+=this.cost(p,a[p],r));let u=md,d=0;for(;u>0&&d+h[u-1]<=r;)d+=h[--u];let f=!1;this.triangles=this.meshes=0;for(let p=0;p<o.n;p++){let b=a[p],m=pi.none;b>=s&&(m0(b)>=u||b>80)&&(m=c.batch[p]!==null&&(l.batch[p]===null||this.isFull(p,b,r))?pi.full:l.batch[p]?pi.coarse:pi.none,this.meshes++,this.triangles+=m===pi.full?c.triangles[p]:l.triangles[p]),m!==this.drawn[p]&&(this.show(p,m),f=!0)}return f}isFull(t,e,n){return this.full.batch[t]===null?!1:e>=(n<1/0?160:mT)}cost(t,e,n){return this.isFull(t,e,n)?this.full.triangles[t]:this.coarse.triangles[t]}show(t,e){let{coarse:n,full:s}=this;n.batch[t]?.setVisible(n.instance[t],e===pi.coarse),s.batch[t]?.setVisible(s.instance[t],e===pi.full),this.drawn[t]=e}measure(t,e,n){let{plant:s,pixels:r,ball:o,eye:a,ahead:l}=this;this.frustum.setFromProjectionMatrix(this.matrix.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse)),a.setFromMatrixPosition(t.matrixWorld),t.getWorldDirection(l);let c="isOrthographicCamera"in t,h=c?e/(t.top-t.bottom):e/(2*Math.tan(t.fov*Math.PI/360));for(let u=0;u<s.n;u++){r[u]=0;let d=s.radius[u];if(!d||!n[u]||(o.center.set(s.center[3*u]+s.offset[3*u],s.center[3*u+1]+s.offset[3*u+1],s.center[3*u+2]+s.offset[3*u+2]),o.radius=d,!this.frustum.intersectsSphere(o)))continue;let f=c?1:Math.max(o.center.sub(a).dot(l),d*.5);r[u]=2*d*h/f}}};function m0(i){return Math.max(0,Math.min(md-1,Math.floor(2*Math.log2(i+1e-6))+8))}var Qi=320,bc=class{height=180;target=new Re(Qi,this.height,{depthBuffer:!1});pixels=null;next=null;toClip=new Mt;fromClip=new Mt;material=vc(u0,{tDepth:{value:null},used:{value:new Et}},{depthTest:!1,depthWrite:!1});scene=new ci;flat=new Kn(-1,1,1,-1,0,1);busy=!1;turn=0;constructor(){let t=new Ie(new Ai(2,2),this.material);t.frustumCulled=!1,this.scene.add(t)}copy(t,e,n){if(this.busy)return!1;this.busy=!0;let s=Math.max(1,Math.round(Qi*t.renderer.domElement.height/t.renderer.domElement.width));s!==this.height&&(this.height=s,this.target.setSize(Qi,s),this.next=null);let{texture:r,used:o}=t.depth;this.material.uniforms.tDepth.value=r,this.material.uniforms.used.value.copy(o),t.renderer.setRenderTarget(this.target),t.renderer.render(this.scene,this.flat),t.renderer.setRenderTarget(null);let a=new Mt().multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),l=this.next??new Uint8Array(4*Qi*s);return t.renderer.readRenderTargetPixelsAsync(this.target,0,0,Qi,s,l).then(()=>{this.next=this.pixels?.length===l.length?this.pixels:null,this.pixels=l,this.toClip.copy(a),this.fromClip.copy(a).invert(),this.busy=!1,this.turn++,n()},()=>this.busy=!1),!0}isBefore(t,e,n){if(!this.pixels)return!1;let s=new Wt(t,e,n,1).applyMatrix4(this.toClip);if(s.w<=0)return!0;let r=Math.floor((s.x/s.w/2+.5)*Qi),o=Math.floor((s.y/s.w/2+.5)*this.height);if(r<1||o<1||r>=Qi-1||o>=this.height-1)return!1;let a=s.z/s.w,l=this.slackAt(s);for(let c=-1;c<=1;c++)for(let h=-1;h<=1;h++){let u=4*((o+c)*Qi+r+h);if((this.pixels[u]+256*this.pixels[u+1]+65536*this.pixels[u+2])/16777215*2-1>=a-l)return!1}return!0}slackAt(t){let e=new Wt(t.x/t.w,t.y/t.w,t.z/t.w,1).applyMatrix4(this.fromClip),n=new Wt(0,0,-1,1).applyMatrix4(this.fromClip),[s,r]=[e.divideScalar(e.w),n.divideScalar(n.w)],o=s.clone().lerp(r,.02).setW(1).applyMatrix4(this.toClip);return Math.max(0,t.z/t.w-o.z/o.w)}};var gT=65535,wc=class{object;bytes;level;meshes;triangles;ranges=[];rangeOf;state;texture;dirty=!1;constructor(t,e,n){let s=0,r=0,o=0;for(let h of t)s+=h.positions.length/3,r+=h.indices.length,o+=e.meshesOfShape.of(h.shape).length;this.level=t[0]?.level??1,this.meshes=new Uint32Array(o),this.triangles=new Uint32Array(o),this.rangeOf=new Uint32Array(o);let a=512,l=Math.max(1,Math.ceil(2*o/a));this.state=new Uint8Array(4*a*l),this.texture=new Ti(this.state,a,l,je,en),this.texture.minFilter=this.texture.magFilter=Se,this.object=new $r(Math.max(o,1),Math.max(s,1),Math.max(r,1),n),this.object.frustumCulled=this.object.perObjectFrustumCulled=this.object.sortObjects=!1,this.object.matrixAutoUpdate=!1;let c=this.object.onBeforeRender;this.object.onBeforeRender=(h,u,d,f,p,b)=>{this.bindState(p),c.call(this.object,h,u,d,f,p,b)};for(let h of t)this.addForm(h,e);this.bytes=s*8+r*(s>gT?4:2)+o*80}addForm(t,e){let n=new Le;n.setAttribute("position",new be(t.positions,3)),n.setAttribute("oct",new be(t.normals,2)),n.setIndex(new be(t.indices,1));let s=this.object.addGeometry(n),r=this.object.getGeometryRangeAt(s);this.ranges.push({vertexStart:r.vertexStart,vertexCount:r.vertexCount,indexStart:r.indexStart,indexCount:r.indexCount,low:t.low,step:t.step});for(let o of e.meshesOfShape.of(t.shape)){let a=this.object.addInstance(s);this.meshes[a]=o,this.triangles[a]=t.indices.length/3,this.rangeOf[a]=this.ranges.length-1,this.object.setVisibleAt(a,!1),this.setMatrix(a,e);let l=8*a+4;this.state[l]=o+1&255,this.state[l+1]=o+1>>8&255,this.state[l+2]=o+1>>16&255}this.dirty=!0}rangeAt(t){return this.ranges[this.rangeOf[t]]}setVisible(t,e){this.object.setVisibleAt(t,e)}setState(t,e,n,s,r){let o=8*t;this.state[o]=e,this.state[o+1]=n,this.state[o+2]=s,this.state[o+3]=r,this.dirty=!0}setMatrix(t,e){this.object.setMatrixAt(t,this.matrixAt(t,e,xT))}matrixAt(t,e,n){let{low:s,step:r}=this.rangeAt(t);return e.matrixOf(this.meshes[t],n),g0.makeScale(r[0]||1e-9,r[1]||1e-9,r[2]||1e-9).setPosition(s[0],s[1],s[2]),n.multiply(g0)}bindState(t){this.dirty&&(this.texture.needsUpdate=!0,this.dirty=!1),t.uniforms.stateTexture.value=this.texture,t.uniformsNeedUpdate=!0}dispose(){this.texture.dispose(),this.object.dispose()}},xT=new Mt,g0=new Mt;function y0(i){let t=new DataView(i);if(i.byteLength<8||t.getUint32(0,!0)!==1128743752)throw new Error("this is no chunk of shapes");let e=t.getUint32(4,!0);if(8+e*48>i.byteLength)throw new Error("a chunk of shapes is cut off");let n=[];for(let s=0;s<e;s++)n.push(vT(i,t,8+s*48));return n}function vT(i,t,e){let[n,s,r,o,a,l]=[0,4,8,12,16,20].map(d=>t.getUint32(e+d,!0)),c=(l&1)!==0,h=a+v0(6*r),u=h+v0(2*r);if(u+(c?4:2)*o>i.byteLength)throw new Error("a chunk of shapes is cut off");return{shape:n,level:s===0?0:1,positions:new Uint16Array(i,a,3*r),normals:new Int8Array(i,h,2*r),indices:c?new Uint32Array(i,u,o):new Uint16Array(i,u,o),low:x0(t,e+24),step:x0(t,e+36)}}function x0(i,t){return[i.getFloat32(t,!0),i.getFloat32(t+4,!0),i.getFloat32(t+8,!0)]}function v0(i){return i+3&-4}var yT=3,bT=6e8,_c=class{bytes=0;share=0;batches=new Map;failed=new Set;source;manifest;plant;culling;pipeline;changed;filling=!1;again=!1;eye=[0,0,0];memory;constructor(t,e,n,s,r,o,a=bT){this.source=t,this.manifest=e,this.plant=n,this.culling=s,this.pipeline=r,this.changed=o,this.memory=a}get isComplete(){return this.share>=1&&!this.filling}async loadCoarse(){let t=this.manifest.chunks.filter(s=>s.level===1),e=t.reduce((s,r)=>s+r.bytes,0)||1,n=0;await b0(t,yT,async s=>{this.bytes+2*s.bytes<=this.memory&&await this.load(s),n+=s.bytes,this.share=Math.min(n/e,.999),this.changed()}),this.share=1,this.changed()}async fill(t){if(this.eye=t,this.share<1)return;if(this.filling){this.again=!0;return}this.filling=!0;let e=new Map(this.manifest.chunks.filter(s=>s.level===0).map(s=>[s,wT(s,t)])),n=[...e.keys()].sort((s,r)=>e.get(r)-e.get(s));try{await b0(n,2,async s=>{this.batches.has(s)||this.failed.has(s)||this.makeRoom(s,e)&&(await this.load(s),this.changed())})}finally{this.filling=!1}this.again&&(this.again=!1,await this.fill(this.eye))}makeRoom(t,e){let n=2*t.bytes,s=[...this.batches.keys()].filter(r=>r.level===0).sort((r,o)=>(e.get(r)??0)-(e.get(o)??0));for(let r of s){if(this.bytes+n<=this.memory||(e.get(r)??0)*1.5>e.get(t))break;this.drop(r)}return this.bytes+n<=this.memory}drop(t){let e=this.batches.get(t);this.batches.delete(t),this.culling.remove(e),this.pipeline.plant.remove(e.object),this.bytes-=2*e.bytes,e.dispose()}async load(t){let e,n=2*t.bytes;this.bytes+=n;try{e=y0(await this.source.file(t.file))}catch(r){throw this.failed.add(t),r}finally{this.bytes-=n}let s=new wc(e,this.plant,this.pipeline.material);for(let r of e){let o=r.low.map((a,l)=>a+r.step[l]*65535);this.plant.setBounds(r.shape,r.low,o)}this.batches.set(t,s),this.bytes+=2*s.bytes,this.pipeline.plant.add(s.object),this.culling.add(s)}dispose(){for(let t of[...this.batches.keys()])this.drop(t)}};function wT(i,t){let e=0,n=0;for(let s=0;s<3;s++)e+=Math.max(i.low[s]-t[s],0,t[s]-i.high[s])**2,n+=(i.high[s]-i.low[s])**2;return Math.sqrt(n)/(Math.sqrt(e)+.1*Math.sqrt(n)+.001)}async function b0(i,t,e){let n=0,s=async()=>{for(;n<i.length;)await e(i[n++])};await Promise.all(Array.from({length:Math.min(t,i.length)},s))}var gd="#c3cad3",_T=["#00224e","#35456c","#666970","#948e77","#c8b866","#fee838"],_0={embedded:["Geometry","#4477aa"],geometry:["Geometry","#4477aa"],lvlm:["Vision-language model","#aa3377"],author:["Given with the scene","#228833"],human:["Corrected by a person","#ee7733"],catalog:["Catalogue","#ccbb44"],file:["The file's own data","#66ccee"],graph:["Neighbours","#997700"],network:["The pipes around it","#997700"],repeat:["Like a corrected part","#f2b27a"]};function Sc(i,t){let{parts:e,groups:n,network:s}=i,r=e.id.length,o=Uint8Array.from(e.state,(p,b)=>p==="sure"||e.ground[b]?0:1);if(t==="original")return{entryOf:new Int32Array(r).fill(-1),entries:[],hatched:new Uint8Array(r)};if(t==="confidence")return ET(i,o);let a=p=>e.unit[p]>=0?s.units[e.unit[p]].system:-1,l=t==="system"?AT(i):null,c={group:p=>n[e.group[p]]?.name??null,name:p=>e.name[p],unit:p=>s.units[e.unit[p]]?.tag??null,system:p=>s.systems[l[p]>=0?l[p]:a(p)]?.id??null,cluster:p=>s.clusters[e.cluster[p]]?.id??null,source:p=>e.source[p]},h=new Map;for(let p=0;p<r;p++){let b=c[t](p),m=h.get(b);m?m.push(p):h.set(b,[p])}let d=[...h.keys()].sort((p,b)=>p===null?1:b===null?-1:ST(p,b,h)).map((p,b)=>({label:p===null?MT(t):t==="source"?_0[p]?.[0]??p:p,color:p===null?gd:TT(t,p,b,i),hatched:p===null,parts:h.get(p)})),f=new Int32Array(r);d.forEach((p,b)=>p.parts.forEach(m=>f[m]=b)),t!=="group"&&t!=="name"&&o.fill(0);for(let p of d)if(p.hatched)for(let b of p.parts)o[b]=e.ground[b]?0:1;return{entryOf:f,entries:d,hatched:o}}function ST(i,t,e){return e.get(t).length-e.get(i).length||(i<t?-1:1)}function MT(i){return{unit:"In no unit",system:"In no system",cluster:"In no structure"}[i]??"No label"}function TT(i,t,e,n){return i==="group"?n.groups.find(s=>s.name===t)?.color??gd:i==="source"?_0[t]?.[1]??w0(e+7):w0(e)}function ET(i,t){let{confidence:e,state:n}=i.parts,s=[.5,.7,.85,.95,.99],r=_T.map((a,l)=>({label:l===0?"below 50 %":l===5?"99 % and more":`${Math.round(s[l-1]*100)} to ${Math.round(s[l]*100)} %`,color:a,hatched:!1,parts:[]}));r.push({label:"No label",color:gd,hatched:!0,parts:[]});let o=Int32Array.from(e,(a,l)=>{let c=a===null||n[l]==="open"?6:s.filter(h=>a>=h).length;return r[c].parts.push(l),c});for(let a=0;a<t.length;a++)t[a]=o[a]===6&&!i.parts.ground[a]?1:0;return{entryOf:o,entries:r,hatched:t}}function AT(i){let{parts:t,network:e}=i,n=new Int32Array(t.id.length).fill(-1);for(let s of e.connections){let r=e.lines[s.line]?.system??-1;for(let o of s.via)n[o]=r}for(let s of e.units)for(let r of s.parts)n[r]=s.system;return n}function w0(i){let t=(210+i*137.508)%360,[e,n]=[[62,52],[55,66],[70,40]][i%3];return PT(CT(t,e/100,n/100))}function CT(i,t,e){let n=s=>{let r=(s+i/30)%12;return Math.round(255*(e-t*Math.min(e,1-e)*Math.max(-1,Math.min(r-3,9-r,1))))};return[n(0),n(8),n(4)]}function S0(i){let t=Number.parseInt(i.slice(1),16);return[t>>16&255,t>>8&255,t&255]}function PT([i,t,e]){return`#${(1<<24|i<<16|t<<8|e).toString(16).slice(1)}`}var RT=.42,LT=4e3,Mc=class{state;visible;hasGhosts=!1;emphasised=[];coloring=null;plant;store;constructor(t,e){this.plant=t,this.store=e,this.state=new Uint8Array(4*t.n),this.visible=new Uint8Array(t.n).fill(1)}recolor(){this.coloring=Sc(this.store.content,this.store.shown.colorBy),this.update()}update(){let{plant:t}=this,e=this.coloring,n=this.store.shown,s=this.flagsOfParts(n),{ground:r}=this.store.content.parts,o=e.entries.map(a=>S0(a.color));this.emphasised=[],this.hasGhosts=!1;for(let a=0;a<t.n;a++){let l=t.partOf[a],c=4*a,h=l>=0?e.entryOf[l]:-1,u=h>=0?o[h]:this.ownColor(a),d=n.theme==="dark"&&l>=0&&r[l]?RT:1;for(let m=0;m<3;m++)this.state[c+m]=Math.round(d*u[m]);let f=l>=0?s[l]:n.isolated||n.marks?xn.ghost:0;l>=0&&e.hatched[l]&&(f|=xn.hatched);let p=l>=0&&n.hidden.has(l),b=(f&xn.ghost)!==0;this.visible[a]=p||t.shapeOf[a]<0||b&&!n.ghost?0:1,this.state[c+3]=f,b&&this.visible[a]&&(this.hasGhosts=!0),f&xn.selected&&this.visible[a]&&this.emphasised.length<LT&&this.emphasised.push(a)}}ownColor(t){let{color:e}=this.plant,n=4*t;return e[n+3]?[e[n],e[n+1],e[n+2]]:[174,183,194]}flagsOfParts(t){let e=this.store.content,n=e.parts.id.length,s=new Uint8Array(n),r=this.onlyThese(t);if(r)for(let a=0;a<n;a++)r.has(a)||(s[a]|=xn.ghost);for(let a of t.question?.alike??[])s[a]|=xn.alike;let o=t.question?t.question.parts:t.selection;for(let a of o)s[a]=(s[a]|xn.selected)&~xn.ghost;for(let a of e.network.units)if(t.marks?.close.has(a.id))for(let l of a.parts)s[l]=(s[l]|xn.marked)&~xn.ghost;return s}onlyThese(t){if(t.explode){let e=this.store.content.network.units.find(n=>n.id===t.explode.unit);if(e)return new Set(e.parts)}return t.marks?t.marks.parts:t.isolated}};var Tc=38,xd=Math.cos(.4*Math.PI/180),Ec=class{perspective=new mn(Tc,1,.01,1e3);parallel=new Kn(-1,1,1,-1,-1e3,1e3);orthographic=!1;eye=new P(-10,-13,9);target=new P;aspect=1;flight=0;bounds={center:[0,0,0],radius:10};moved;constructor(t){this.moved=t;for(let e of[this.perspective,this.parallel])e.up.set(0,0,1)}get camera(){return this.orthographic?this.parallel:this.perspective}setBounds(t){this.bounds=t}setAspect(t){this.aspect=t,this.place()}get(){return{eye:this.eye.toArray(),target:this.target.toArray(),orthographic:this.orthographic}}set(t){this.stop(),this.orthographic=t.orthographic,this.eye.fromArray(t.eye),this.target.fromArray(t.target),this.place()}setOrthographic(t){this.orthographic=t,this.place()}pixelAt(t,e){return 2*(this.orthographic?this.distance:Math.max(this.depthOf(t),1e-6))*Math.tan(Tc*Math.PI/360)/e}orbit(t,e,n){this.stop();let s=-e,r=this.right();for(let l of[this.eye,this.target])l.sub(t).applyAxisAngle(So,s).add(t);r.applyAxisAngle(So,s);let o=[this.eye.clone(),this.target.clone()];for(let l of[this.eye,this.target])l.sub(t).applyAxisAngle(r,-n).add(t);let a=this.ahead();(Math.abs(a.z)>xd||a.dot(new P().crossVectors(So,r))<0)&&(this.eye.copy(o[0]),this.target.copy(o[1])),this.place()}pan(t,e,n,s){this.stop();let r=this.pixelAt(t,s),o=this.right(),a=new P().crossVectors(o,this.ahead()),l=o.multiplyScalar(-e*r).addScaledVector(a,n*r);this.eye.add(l),this.target.add(l),this.place()}zoom(t,e){this.stop();let n=this.bounds.radius*1e-5;e<1&&this.distance*e<n||e>1&&this.distance*e>this.bounds.radius*40||(this.eye.sub(t).multiplyScalar(e).add(t),this.target.sub(t).multiplyScalar(e).add(t),this.place())}flyTo(t,e,n=!0,s=1.08){let r=(e??this.ahead().negate()).clone().normalize();Math.abs(r.z)>xd&&r.set(0,-Math.sqrt(1-xd**2),r.z).normalize();let{target:o,distance:a}=this.fit(t,r,s);this.travel(o.clone().addScaledVector(r,a),o,n)}fit(t,e,n){let s=new P().crossVectors(So,e).normalize(),r=new P().crossVectors(e,s),o=Math.tan(Tc*Math.PI/360)/n,a=o*this.aspect,l=IT(t),c=0,h=new P;for(let u=0;u<4;u++){c=this.bounds.radius*1e-4;for(let p=0;p<t.length;p+=3){h.fromArray(t,p).sub(l);let b=Math.max(Math.abs(h.dot(s))/a,Math.abs(h.dot(r))/o);c=Math.max(c,b+h.dot(e))}let d=[1/0,-1/0],f=[1/0,-1/0];for(let p=0;p<t.length;p+=3){h.fromArray(t,p).sub(l);let b=this.orthographic?c:Math.max(c-h.dot(e),1e-6),[m,g]=[h.dot(s)/b,h.dot(r)/b];[d[0],d[1]]=[Math.min(d[0],m),Math.max(d[1],m)],[f[0],f[1]]=[Math.min(f[0],g),Math.max(f[1],g)]}u<3&&l.addScaledVector(s,(d[0]+d[1])/2*c).addScaledVector(r,(f[0]+f[1])/2*c)}return{target:l,distance:c}}travel(t,e,n){if(this.stop(),!n||matchMedia("(prefers-reduced-motion: reduce)").matches){this.eye.copy(t),this.target.copy(e),this.place();return}let[r,o]=[this.eye.clone(),this.target.clone()],a=performance.now(),l=c=>{let h=Math.min(1,Math.max(0,(c-a)/420)),u=h*h*(3-2*h);this.target.lerpVectors(o,e,u),this.eye.lerpVectors(r,t,u),this.place(),this.flight=h<1?requestAnimationFrame(l):0};this.flight=requestAnimationFrame(l)}stop(){this.flight&&cancelAnimationFrame(this.flight),this.flight=0}get distance(){return this.eye.distanceTo(this.target)}ahead(){return new P().subVectors(this.target,this.eye).normalize()}right(){let t=new P().crossVectors(this.ahead(),So);return t.lengthSq()>1e-9?t.normalize():t.set(1,0,0)}depthOf(t){return t.clone().sub(this.eye).dot(this.ahead())}place(){let t=new P(...this.bounds.center),e=this.bounds.radius*1.3,n=this.depthOf(t),{perspective:s,parallel:r}=this;s.far=Math.max(n+e,this.bounds.radius*.01),s.near=Math.max(n-e,s.far/2e4),s.aspect=this.aspect;let o=this.distance*Math.tan(Tc*Math.PI/360);r.top=o,r.bottom=-o,r.left=-o*this.aspect,r.right=o*this.aspect,r.near=n-e,r.far=n+e;for(let a of[s,r])a.position.copy(this.eye),a.lookAt(this.target),a.updateMatrixWorld(),a.updateProjectionMatrix();this.moved()}},So=new P(0,0,1);function IT(i){let t=new P(1/0,1/0,1/0),e=new P(-1/0,-1/0,-1/0),n=new P;for(let s=0;s<i.length;s+=3)n.fromArray(i,s),t.min(n),e.max(n);return t.add(e).multiplyScalar(.5)}var dr=Math.pow(2,-24),Mo=Symbol("SKIP_GENERATION"),Ac={strategy:0,maxDepth:40,targetLeafSize:10,useSharedArrayBuffer:!1,setBoundingBox:!0,onProgress:null,indirect:!1,verbose:!0,range:null,[Mo]:!1};function fe(i,t,e){return e.min.x=t[i],e.min.y=t[i+1],e.min.z=t[i+2],e.max.x=t[i+3],e.max.y=t[i+4],e.max.z=t[i+5],e}function To(i){let t=-1,e=-1/0;for(let n=0;n<3;n++){let s=i[n+3]-i[n];s>e&&(e=s,t=n)}return t}function vd(i,t,e){for(let n=0;n<3;n++){let s=t[i+2*n],r=t[i+2*n+1],o=s-r,a=s+r;o<e[n]&&(e[n]=o),a>e[n+3]&&(e[n+3]=a)}}function Cc(i){let t=i[3]-i[0],e=i[4]-i[1],n=i[5]-i[2];return 2*(t*e+e*n+n*t)}function Kt(i,t){return t[i+15]===65535}function oe(i,t){return t[i+6]}function ce(i,t){return t[i+14]}function ne(i){return i+8}function ie(i,t){let e=t[i+6];return i+e*8}function fr(i,t){return t[i+7]}function Pc(i,t,e,n,s){let r=1/0,o=1/0,a=1/0,l=-1/0,c=-1/0,h=-1/0,u=1/0,d=1/0,f=1/0,p=-1/0,b=-1/0,m=-1/0,g=i.offset||0;for(let w=(t-g)*6,S=(t+e-g)*6;w<S;w+=6){let x=i[w+0],_=i[w+1],A=x-_,v=x+_;A<r&&(r=A),v>l&&(l=v),x<u&&(u=x),x>p&&(p=x);let M=i[w+2],N=i[w+3],C=M-N,L=M+N;C<o&&(o=C),L>c&&(c=L),M<d&&(d=M),M>b&&(b=M);let I=i[w+4],F=i[w+5],k=I-F,B=I+F;k<a&&(a=k),B>h&&(h=B),I<f&&(f=I),I>m&&(m=I)}n[0]=r,n[1]=o,n[2]=a,n[3]=l,n[4]=c,n[5]=h,s[0]=u,s[1]=d,s[2]=f,s[3]=p,s[4]=b,s[5]=m}var gi=8,bd=8,yd=new Int32Array(gi),mi=new Float32Array(gi*6),pr=new Float32Array(gi*6),ti=new Float32Array(6),Rc=new Float32Array(6),ts=new Int32Array(bd),T0=new Float32Array(bd*6);function DT(i,t,e,n){for(let s=0;s<3;s++){let r=t[i+2*s],o=t[i+2*s+1],a=r-o,l=r+o;a<e[n+s]&&(e[n+s]=a),l>e[n+s+3]&&(e[n+s+3]=l)}}function E0(i,t){let e=i[t+3]-i[t],n=i[t+4]-i[t+1],s=i[t+5]-i[t+2];return 2*(e*n+n*s+s*e)}function A0(i,t,e,n,s,r){let o=-1,a=0;if(r===0)o=To(t),o!==-1&&(a=(t[o]+t[o+3])/2);else if(r===1)o=To(i),o!==-1&&(a=OT(e,n,s,o));else if(r===2){let l=Cc(i),c=1.25*s,h=e.offset||0,u=(n-h)*6,d=(n+s-h)*6;for(let f=0;f<3;f++){let p=t[f],g=(t[f+3]-p)/gi;if(s<bd){for(let w=0;w<s;w++){let S=u+w*6,x=e[S+2*f],_=w;for(;_>0&&e[ts[_-1]+2*f]>x;)ts[_]=ts[_-1],_--;ts[_]=S}for(let w=0;w<3;w++)ti[w]=1/0,ti[w+3]=-1/0,Rc[w]=1/0,Rc[w+3]=-1/0;for(let w=s-1;w>=0;w--)vd(ts[w],e,Rc),T0.set(Rc,w*6);for(let w=0;w<s-1;w++){vd(ts[w],e,ti);let S=e[ts[w+1]+2*f];if(e[ts[w]+2*f]===S)continue;let x=w+1,_=s-x,A=Cc(ti)/l,v=E0(T0,x*6)/l,M=1+1.25*(A*x+v*_);M<c&&(o=f,c=M,a=S)}}else{for(let x=0;x<gi;x++){yd[x]=0;for(let _=0;_<3;_++)mi[x*6+_]=1/0,mi[x*6+_+3]=-1/0}for(let x=u;x<d;x+=6){let v=~~((e[x+2*f]-p)/g);v>=gi&&(v=gi-1),yd[v]++,DT(x,e,mi,v*6)}let w=(gi-1)*6;for(let x=0;x<6;x++)pr[w+x]=mi[w+x];for(let x=gi-2;x>=0;x--){let _=x*6,A=_+6;for(let v=0;v<3;v++)pr[_+v]=Math.min(mi[_+v],pr[A+v]),pr[_+v+3]=Math.max(mi[_+v+3],pr[A+v+3])}let S=0;for(let x=0;x<gi-1;x++){let _=x*6,A=yd[x];if(A!==0)for(let L=0;L<3;L++)S===0?(ti[L]=mi[_+L],ti[L+3]=mi[_+L+3]):(ti[L]=Math.min(ti[L],mi[_+L]),ti[L+3]=Math.max(ti[L+3],mi[_+L+3]));S+=A;let v=0,M=0;S!==0&&(v=Cc(ti)/l);let N=s-S;N!==0&&(M=E0(pr,_+6)/l);let C=1+1.25*(v*S+M*N);C<c&&(o=f,c=C,a=p+g+x*g)}}}}else console.warn(`BVH: Invalid build strategy value ${r} used.`);return{axis:o,pos:a}}function OT(i,t,e,n){let s=0,r=i.offset;for(let o=t,a=t+e;o<a;o++)s+=i[(o-r)*6+n*2];return s/e}function C0(i,t,e,n,s,r){let o=n,a=n+s-1,l=r.pos,c=r.axis*2,h=e.offset||0;for(;;){for(;o<=a&&e[(o-h)*6+c]<l;)o++;for(;o<=a&&e[(a-h)*6+c]>=l;)a--;if(o<a){for(let u=0;u<t;u++){let d=i[o*t+u];i[o*t+u]=i[a*t+u],i[a*t+u]=d}for(let u=0;u<6;u++){let d=o-h,f=a-h,p=e[d*6+u];e[d*6+u]=e[f*6+u],e[f*6+u]=p}o++,a--}else return o}}var FT=Math.pow(2,32),mr=new Float32Array(6),Lc=new Float32Array(6);function UT(i,t,e,n,s,r){let{maxDepth:o,verbose:a,targetLeafSize:l,_strictLeafSize:c=1/0,strategy:h,onProgress:u,useSharedArrayBuffer:d=!1}=s,f=i.primitiveBuffer,p=i.primitiveBufferStride,b=d?SharedArrayBuffer:ArrayBuffer,m=new b(32*Math.max(1,2*Math.ceil(n)-1)),g=new Float32Array(m),w=new Uint32Array(m),S=new Uint16Array(m),x=0,_=!1;return Pc(t,e,n,mr,Lc),M(e,n,0),m.slice(0,x*32);function A(N){u&&u((N-r.offset)/r.count)}function v(N,C,L){let I=N*2;w[N+6]=C,S[I+14]=L,S[I+15]=65535,A(C+L)}function M(N,C,L){let I=x++,F=I*8;g.set(mr,F),!_&&L>=o&&(_=!0,a&&console.warn(`BVH: Max depth of ${o} reached when generating BVH. Consider increasing maxDepth.`));let k=C>c;if(C<=l&&!k||L>=o){v(F,N,C);return}let B=A0(mr,Lc,t,N,C,h),G=B.axis===-1?-1:C0(f,p,t,N,C,B);if(B.axis===-1||G===N||G===N+C){if(!k){v(F,N,C);return}B.axis=Math.max(0,To(mr)),G=N+Math.max(1,Math.floor(C/2))}w[F+7]=B.axis;let W=G-N;Pc(t,N,W,mr,Lc),M(N,W,L+1);let et=x-I;if(et>FT)throw new Error("MeshBVH: Cannot store relative child node offset greater than 32 bits.");w[F+6]=et;let X=C-W;Pc(t,G,X,mr,Lc),M(G,X,L+1)}}function P0(i,t){let e=i.getRootRanges(t.range),n=e[0],s=e[e.length-1],r={offset:n.offset,count:s.offset+s.count-n.offset},o=new Float32Array(6*r.count);o.offset=r.offset,i.computePrimitiveBounds(r.offset,r.count,o),i._roots=e.map(a=>UT(i,o,a.offset,a.count,t,r))}var es=class{constructor(t){this._getNewPrimitive=t,this._primitives=[]}getPrimitive(){let t=this._primitives;return t.length===0?this._getNewPrimitive():t.pop()}releasePrimitive(t){this._primitives.push(t)}};var wd=class{constructor(){this.float32Array=null,this.uint16Array=null,this.uint32Array=null;let t=[],e=null;this.setBuffer=n=>{e&&t.push(e),e=n,this.float32Array=new Float32Array(n),this.uint16Array=new Uint16Array(n),this.uint32Array=new Uint32Array(n)},this.clearBuffer=()=>{e=null,this.float32Array=null,this.uint16Array=null,this.uint32Array=null,t.length!==0&&this.setBuffer(t.pop())}}},Xt=new wd;var ns,xr,gr=[],Ic=new es(()=>new le);function R0(i,t,e,n,s,r){ns=Ic.getPrimitive(),xr=Ic.getPrimitive(),gr.push(ns,xr),Xt.setBuffer(i._roots[t]);let o=_d(0,i.geometry,e,n,s,r);Xt.clearBuffer(),Ic.releasePrimitive(ns),Ic.releasePrimitive(xr),gr.pop(),gr.pop();let a=gr.length;return a>0&&(xr=gr[a-1],ns=gr[a-2]),o}function _d(i,t,e,n,s=null,r=0,o=0){let{float32Array:a,uint16Array:l,uint32Array:c}=Xt,h=i*2;if(Kt(h,l)){let d=oe(i,c),f=ce(h,l);return fe(i,a,ns),n(d,f,!1,o,r+i/8,ns)}else{let C=function(I){let{uint16Array:F,uint32Array:k}=Xt,B=I*2;for(;!Kt(B,F);)I=ne(I),B=I*2;return oe(I,k)},L=function(I){let{uint16Array:F,uint32Array:k}=Xt,B=I*2;for(;!Kt(B,F);)I=ie(I,k),B=I*2;return oe(I,k)+ce(B,F)},d=ne(i),f=ie(i,c),p=d,b=f,m,g,w,S;if(s&&(w=ns,S=xr,fe(p,a,w),fe(b,a,S),m=s(w),g=s(S),g<m)){p=f,b=d;let I=m;m=g,g=I,w=S}w||(w=ns,fe(p,a,w));let x=Kt(p*2,l),_=e(w,x,m,o+1,r+p/8),A;if(_===2){let I=C(p),k=L(p)-I;A=n(I,k,!0,o+1,r+p/8,w)}else A=_&&_d(p,t,e,n,s,r,o+1);if(A)return!0;S=xr,fe(b,a,S);let v=Kt(b*2,l),M=e(S,v,g,o+1,r+b/8),N;if(M===2){let I=C(b),k=L(b)-I;N=n(I,k,!0,o+1,r+b/8,S)}else N=M&&_d(b,t,e,n,s,r,o+1);return!!N}}var Eo=new Xt.constructor,kc=new Xt.constructor,is=new es(()=>new le),vr=new le,yr=new le,Md=new le,Td=new le,Ed=!1;function L0(i,t,e,n){if(Ed)throw new Error("MeshBVH: Recursive calls to bvhcast not supported.");Ed=!0;let s=i._roots,r=t._roots,o,a=0,l=0,c=new Mt().copy(e).invert();for(let h=0,u=s.length;h<u;h++){Eo.setBuffer(s[h]),l=0;let d=is.getPrimitive();fe(0,Eo.float32Array,d),d.applyMatrix4(c);for(let f=0,p=r.length;f<p&&(kc.setBuffer(r[f]),o=ei(0,0,e,c,n,a,l,0,0,d),kc.clearBuffer(),l+=r[f].byteLength/32,!o);f++);if(is.releasePrimitive(d),Eo.clearBuffer(),a+=s[h].byteLength/32,o)break}return Ed=!1,o}function ei(i,t,e,n,s,r=0,o=0,a=0,l=0,c=null,h=!1){let u,d;h?(u=kc,d=Eo):(u=Eo,d=kc);let f=u.float32Array,p=u.uint32Array,b=u.uint16Array,m=d.float32Array,g=d.uint32Array,w=d.uint16Array,S=i*2,x=t*2,_=Kt(S,b),A=Kt(x,w),v=!1;if(A&&_)h?v=s(oe(t,g),ce(t*2,w),oe(i,p),ce(i*2,b),l,o+t/8,a,r+i/8):v=s(oe(i,p),ce(i*2,b),oe(t,g),ce(t*2,w),a,r+i/8,l,o+t/8);else if(A){let M=is.getPrimitive();fe(t,m,M),M.applyMatrix4(e);let N=ne(i),C=ie(i,p);fe(N,f,vr),fe(C,f,yr);let L=M.intersectsBox(vr),I=M.intersectsBox(yr);v=L&&ei(t,N,n,e,s,o,r,l,a+1,M,!h)||I&&ei(t,C,n,e,s,o,r,l,a+1,M,!h),is.releasePrimitive(M)}else{let M=ne(t),N=ie(t,g);fe(M,m,Md),fe(N,m,Td);let C=c.intersectsBox(Md),L=c.intersectsBox(Td);if(C&&L)v=ei(i,M,e,n,s,r,o,a,l+1,c,h)||ei(i,N,e,n,s,r,o,a,l+1,c,h);else if(C)if(_)v=ei(i,M,e,n,s,r,o,a,l+1,c,h);else{let I=is.getPrimitive();I.copy(Md).applyMatrix4(e);let F=ne(i),k=ie(i,p);fe(F,f,vr),fe(k,f,yr);let B=I.intersectsBox(vr),G=I.intersectsBox(yr);v=B&&ei(M,F,n,e,s,o,r,l,a+1,I,!h)||G&&ei(M,k,n,e,s,o,r,l,a+1,I,!h),is.releasePrimitive(I)}else if(L)if(_)v=ei(i,N,e,n,s,r,o,a,l+1,c,h);else{let I=is.getPrimitive();I.copy(Td).applyMatrix4(e);let F=ne(i),k=ie(i,p);fe(F,f,vr),fe(k,f,yr);let B=I.intersectsBox(vr),G=I.intersectsBox(yr);v=B&&ei(N,F,n,e,s,o,r,l,a+1,I,!h)||G&&ei(N,k,n,e,s,o,r,l,a+1,I,!h),is.releasePrimitive(I)}}return v}var Nc=new class{constructor(){let i=null,t=null,e=null,n=!1;this.root=null,this.buffer=null,this.uint32Array=null,this.uint16Array=null,this.setBVH=(r,o)=>{if(n)throw new Error("BVHTraversalHelper: cannot call setBVH during an active traversal.");this.root=o,this.buffer=i=r._roots[o],this.uint16Array=e=new Uint16Array(i),this.uint32Array=t=new Uint32Array(i)},this.reset=()=>{this.root=null,this.buffer=i=null,this.uint16Array=e=null,this.uint32Array=t=null},this.getRangeStart=r=>{let o=r*2;for(;!Kt(o,e);)r=ne(r),o=r*2;return oe(r,t)},this.getRangeEnd=r=>{let o=r*2;for(;!Kt(o,e);)r=ie(r,t),o=r*2;return oe(r,t)+ce(o,e)};let s=(r,o,a)=>{let l=o*2,c=Kt(l,e);if(!r(a,c,o)&&!c){let u=ne(o),d=ie(o,t);s(r,u,a+1),s(r,d,a+1)}};this.traverseBuffer=r=>{if(n)throw new Error("BVHTraversalHelper: cannot start a traversal during an active traversal.");n=!0;try{s(r,0,0)}finally{n=!1}},this.traverse=r=>{this.traverseBuffer((o,a,l)=>{if(a){let c=l*2,h=t[l+6],u=e[c+14];return r(o,a,new Float32Array(i,l*4,6),h,u)}else{let c=fr(l,t);return r(o,a,new Float32Array(i,l*4,6),c)}})}}};var I0=new le,br=new Float32Array(6),Dc=class{constructor(){this._roots=null,this.primitiveBuffer=null,this.primitiveBufferStride=null}init(t){t={...Ac,...t},"maxLeafSize"in t&&(console.warn('BVH: "maxLeafSize" option has been deprecated. Use "targetLeafSize", instead.'),t={...t,targetLeafSize:t.maxLeafSize}),P0(this,t)}getRootRanges(){throw new Error("BVH: getRootRanges() not implemented")}writePrimitiveBounds(){throw new Error("BVH: writePrimitiveBounds() not implemented")}writePrimitiveRangeBounds(t,e,n,s){let r=1/0,o=1/0,a=1/0,l=-1/0,c=-1/0,h=-1/0;for(let u=t,d=t+e;u<d;u++){this.writePrimitiveBounds(u,br,0);let[f,p,b,m,g,w]=br;f<r&&(r=f),m>l&&(l=m),p<o&&(o=p),g>c&&(c=g),b<a&&(a=b),w>h&&(h=w)}return n[s+0]=r,n[s+1]=o,n[s+2]=a,n[s+3]=l,n[s+4]=c,n[s+5]=h,n}computePrimitiveBounds(t,e,n){let s=n.offset||0;for(let r=t,o=t+e;r<o;r++){this.writePrimitiveBounds(r,br,0);let[a,l,c,h,u,d]=br,f=(a+h)/2,p=(l+u)/2,b=(c+d)/2,m=(h-a)/2,g=(u-l)/2,w=(d-c)/2,S=(r-s)*6;n[S+0]=f,n[S+1]=m+(Math.abs(f)+m)*dr,n[S+2]=p,n[S+3]=g+(Math.abs(p)+g)*dr,n[S+4]=b,n[S+5]=w+(Math.abs(b)+w)*dr}return n}shiftPrimitiveOffsets(t){let e=this._indirectBuffer;if(e)for(let n=0,s=e.length;n<s;n++)e[n]+=t;else{let n=this._roots;for(let s=0;s<n.length;s++){let r=n[s],o=new Uint32Array(r),a=new Uint16Array(r),l=r.byteLength/32;for(let c=0;c<l;c++){let h=8*c,u=2*h;Kt(u,a)&&(o[h+6]+=t)}}}}traverse(t,e=0){Nc.setBVH(this,e),Nc.traverse(t),Nc.reset()}refit(){let t=this._roots;for(let e=0,n=t.length;e<n;e++){let s=t[e],r=new Uint32Array(s),o=new Uint16Array(s),a=new Float32Array(s),l=s.byteLength/32;for(let c=l-1;c>=0;c--){let h=c*8,u=h*2;if(Kt(u,o)){let f=oe(h,r),p=ce(u,o);this.writePrimitiveRangeBounds(f,p,br,0),a.set(br,h)}else{let f=ne(h),p=ie(h,r);for(let b=0;b<3;b++){let m=a[f+b],g=a[f+b+3],w=a[p+b],S=a[p+b+3];a[h+b]=m<w?m:w,a[h+b+3]=g>S?g:S}}}}}getBoundingBox(t){return t.makeEmpty(),this._roots.forEach(n=>{fe(0,new Float32Array(n),I0),t.union(I0)}),t}shapecast(t){let{boundsTraverseOrder:e,intersectsBounds:n,intersectsRange:s,intersectsPrimitive:r,scratchPrimitive:o,iterate:a}=t;if(s&&r){let u=s;s=(d,f,p,b,m)=>u(d,f,p,b,m)?!0:a(d,f,this,r,p,b,o)}else s||(r?s=(u,d,f,p)=>a(u,d,this,r,f,p,o):s=(u,d,f)=>f);let l=!1,c=0,h=this._roots;for(let u=0,d=h.length;u<d;u++){let f=h[u];if(l=R0(this,u,n,s,e,c),l)break;c+=f.byteLength/32}return l}bvhcast(t,e,n){let{intersectsRanges:s}=n;return L0(this,t,e,s)}};function k0(){return typeof SharedArrayBuffer<"u"}function Ad(i){return i.index?i.index.count:i.attributes.position.count}function ss(i){return Ad(i)/3}function zT(i,t=ArrayBuffer){return i>65535?new Uint32Array(new t(4*i)):new Uint16Array(new t(2*i))}function N0(i,t){if(!i.index){let e=i.attributes.position.count,n=t.useSharedArrayBuffer?SharedArrayBuffer:ArrayBuffer,s=zT(e,n);i.setIndex(new be(s,1));for(let r=0;r<e;r++)s[r]=r}}function VT(i,t,e){let n=Ad(i)/e,s=t||i.drawRange,r=s.start/e,o=(s.start+s.count)/e,a=Math.max(0,r),l=Math.min(n,o)-a;return{offset:Math.floor(a),count:Math.floor(l)}}function HT(i,t){return i.groups.map(e=>({offset:e.start/t,count:e.count/t}))}function Cd(i,t,e){let n=VT(i,t,e),s=HT(i,e);if(!s.length)return[n];let r=[],o=n.offset,a=n.offset+n.count,l=Ad(i)/e,c=[];for(let d of s){let{offset:f,count:p}=d,b=f,m=isFinite(p)?p:l-f,g=f+m;b<a&&g>o&&(c.push({pos:Math.max(o,b),isStart:!0}),c.push({pos:Math.min(a,g),isStart:!1}))}c.sort((d,f)=>d.pos!==f.pos?d.pos-f.pos:d.type==="end"?-1:1);let h=0,u=null;for(let d of c){let f=d.pos;h!==0&&f!==u&&r.push({offset:u,count:f-u}),h+=d.isStart?1:-1,u=f}return r}function GT(i,t){let e=i[i.length-1],n=e.offset+e.count>2**16,s=i.reduce((c,h)=>c+h.count,0),r=n?4:2,o=t?new SharedArrayBuffer(s*r):new ArrayBuffer(s*r),a=n?new Uint32Array(o):new Uint16Array(o),l=0;for(let c=0;c<i.length;c++){let{offset:h,count:u}=i[c];for(let d=0;d<u;d++)a[l+d]=h+d;l+=u}return a}var Oc=class extends Dc{get indirect(){return!!this._indirectBuffer}get primitiveStride(){return null}get primitiveBufferStride(){return this.indirect?1:this.primitiveStride}set primitiveBufferStride(t){}get primitiveBuffer(){return this.indirect?this._indirectBuffer:this.geometry.index.array}set primitiveBuffer(t){}constructor(t,e={}){if(t.isBufferGeometry){if(t.index&&t.index.isInterleavedBufferAttribute)throw new Error("BVH: InterleavedBufferAttribute is not supported for the index attribute.")}else throw new Error("BVH: Only BufferGeometries are supported.");if(e.useSharedArrayBuffer&&!k0())throw new Error("BVH: SharedArrayBuffer is not available.");super(),this.geometry=t,this.resolvePrimitiveIndex=e.indirect?n=>this._indirectBuffer[n]:n=>n,this.primitiveBuffer=null,this.primitiveBufferStride=null,this._indirectBuffer=null,e={...Ac,...e},e[Mo]||this.init(e)}init(t){let{geometry:e,primitiveStride:n}=this;if(t.indirect){let s=Cd(e,t.range,n),r=GT(s,t.useSharedArrayBuffer);this._indirectBuffer=r}else N0(e,t);super.init(t),!e.boundingBox&&t.setBoundingBox&&(e.boundingBox=this.getBoundingBox(new le))}getRootRanges(t){return this.indirect?[{offset:0,count:this._indirectBuffer.length}]:Cd(this.geometry,t,this.primitiveStride)}raycastObject3D(){throw new Error("BVH: raycastObject3D() not implemented")}};var Dn=class{constructor(){this.min=1/0,this.max=-1/0}setFromPointsField(t,e){let n=1/0,s=-1/0;for(let r=0,o=t.length;r<o;r++){let l=t[r][e];n=l<n?l:n,s=l>s?l:s}this.min=n,this.max=s}setFromPoints(t,e){let n=1/0,s=-1/0;for(let r=0,o=e.length;r<o;r++){let a=e[r],l=t.dot(a);n=l<n?l:n,s=l>s?l:s}this.min=n,this.max=s}isSeparated(t){return this.min>t.max||t.min>this.max}};Dn.prototype.setFromBox=(function(){let i=new P;return function(e,n){let s=n.min,r=n.max,o=1/0,a=-1/0;for(let l=0;l<=1;l++)for(let c=0;c<=1;c++)for(let h=0;h<=1;h++){i.x=s.x*l+r.x*(1-l),i.y=s.y*c+r.y*(1-c),i.z=s.z*h+r.z*(1-h);let u=e.dot(i);o=Math.min(u,o),a=Math.max(u,a)}this.min=o,this.max=a}})();var WT=(function(){let i=new P,t=new P,e=new P;return function(s,r,o){let a=s.start,l=i,c=r.start,h=t;e.subVectors(a,c),i.subVectors(s.end,s.start),t.subVectors(r.end,r.start);let u=e.dot(h),d=h.dot(l),f=h.dot(h),p=e.dot(l),m=l.dot(l)*f-d*d,g,w;m!==0?g=(u*d-p*f)/m:g=0,w=(u+g*d)/f,o.x=g,o.y=w}})(),Ao=(function(){let i=new Et,t=new P,e=new P;return function(s,r,o,a){WT(s,r,i);let l=i.x,c=i.y;if(l>=0&&l<=1&&c>=0&&c<=1){s.at(l,o),r.at(c,a);return}else if(l>=0&&l<=1){c<0?r.at(0,a):r.at(1,a),s.closestPointToPoint(a,!0,o);return}else if(c>=0&&c<=1){l<0?s.at(0,o):s.at(1,o),r.closestPointToPoint(o,!0,a);return}else{let h;l<0?h=s.start:h=s.end;let u;c<0?u=r.start:u=r.end;let d=t,f=e;if(s.closestPointToPoint(u,!0,t),r.closestPointToPoint(h,!0,e),d.distanceToSquared(u)<=f.distanceToSquared(h)){o.copy(d),a.copy(u);return}else{o.copy(h),a.copy(f);return}}}})(),D0=(function(){let i=new P,t=new P,e=new pn,n=new Qe;return function(r,o){let{radius:a,center:l}=r,{a:c,b:h,c:u}=o;if(n.start=c,n.end=h,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a||(n.start=c,n.end=u,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a)||(n.start=h,n.end=u,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a))return!0;let b=o.getPlane(e);if(Math.abs(b.distanceToPoint(l))<=a){let g=b.projectPoint(l,t);if(o.containsPoint(g))return!0}return!1}})();var $T=["x","y","z"],ki=1e-15,O0=ki*ki;function $n(i){return Math.abs(i)<ki}var nn=class extends cn{constructor(...t){super(...t),this.isExtendedTriangle=!0,this.satAxes=new Array(4).fill().map(()=>new P),this.satBounds=new Array(4).fill().map(()=>new Dn),this.points=[this.a,this.b,this.c],this.plane=new pn,this.isDegenerateIntoSegment=!1,this.isDegenerateIntoPoint=!1,this.degenerateSegment=new Qe,this.needsUpdate=!0}intersectsSphere(t){return D0(t,this)}update(){let t=this.a,e=this.b,n=this.c,s=this.points,r=this.satAxes,o=this.satBounds,a=r[0],l=o[0];this.getNormal(a),l.setFromPoints(a,s);let c=r[1],h=o[1];c.subVectors(t,e),h.setFromPoints(c,s);let u=r[2],d=o[2];u.subVectors(e,n),d.setFromPoints(u,s);let f=r[3],p=o[3];f.subVectors(n,t),p.setFromPoints(f,s);let b=c.length(),m=u.length(),g=f.length();this.isDegenerateIntoPoint=!1,this.isDegenerateIntoSegment=!1,b<ki?m<ki||g<ki?this.isDegenerateIntoPoint=!0:(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(t),this.degenerateSegment.end.copy(n)):m<ki?g<ki?this.isDegenerateIntoPoint=!0:(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(e),this.degenerateSegment.end.copy(t)):g<ki&&(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(n),this.degenerateSegment.end.copy(e)),this.plane.setFromNormalAndCoplanarPoint(a,t),this.needsUpdate=!1}};nn.prototype.closestPointToSegment=(function(){let i=new P,t=new P,e=new Qe;return function(s,r=null,o=null){this.needsUpdate&&this.update();let{start:a,end:l}=s,c=this.points,h,u=1/0,d=this.plane.distanceToPoint(a),f=this.plane.distanceToPoint(l);if(d*f<0&&this.plane.intersectLine(s,i)!==null&&this.containsPoint(i))return r&&r.copy(i),o&&o.copy(i),0;for(let p=0;p<3;p++){let b=(p+1)%3;e.start.copy(c[p]),e.end.copy(c[b]),Ao(e,s,i,t),h=i.distanceToSquared(t),h<u&&(u=h,r&&r.copy(i),o&&o.copy(t))}return this.closestPointToPoint(a,i),h=a.distanceToSquared(i),h<u&&(u=h,r&&r.copy(i),o&&o.copy(a)),this.closestPointToPoint(l,i),h=l.distanceToSquared(i),h<u&&(u=h,r&&r.copy(i),o&&o.copy(l)),Math.sqrt(u)}})();nn.prototype.intersectsTriangle=(function(){let i=new nn,t=new Dn,e=new Dn,n=new P,s=new P,r=new P,o=new P,a=new Qe,l=new Qe,c=new P,h=new Et,u=new Et;function d(S,x,_,A){let v=n;!S.isDegenerateIntoPoint&&!S.isDegenerateIntoSegment?v.copy(S.plane.normal):v.copy(x.plane.normal);let M=S.satBounds,N=S.satAxes;for(let I=1;I<4;I++){let F=M[I],k=N[I];if(t.setFromPoints(k,x.points),F.isSeparated(t)||(o.copy(v).cross(k),t.setFromPoints(o,S.points),e.setFromPoints(o,x.points),t.isSeparated(e)))return!1}let C=x.satBounds,L=x.satAxes;for(let I=1;I<4;I++){let F=C[I],k=L[I];if(t.setFromPoints(k,S.points),F.isSeparated(t)||(o.crossVectors(v,k),t.setFromPoints(o,S.points),e.setFromPoints(o,x.points),t.isSeparated(e)))return!1}return _&&(A||console.warn("ExtendedTriangle.intersectsTriangle: Triangles are coplanar which does not support an output edge. Setting edge to 0, 0, 0."),_.start.set(0,0,0),_.end.set(0,0,0)),!0}function f(S,x,_,A,v,M,N,C,L,I,F){let k=N/(N-C);I.x=A+(v-A)*k,F.start.subVectors(x,S).multiplyScalar(k).add(S),k=N/(N-L),I.y=A+(M-A)*k,F.end.subVectors(_,S).multiplyScalar(k).add(S)}function p(S,x,_,A,v,M,N,C,L,I,F){if(v>0)f(S.c,S.a,S.b,A,x,_,L,N,C,I,F);else if(M>0)f(S.b,S.a,S.c,_,x,A,C,N,L,I,F);else if(C*L>0||N!=0)f(S.a,S.b,S.c,x,_,A,N,C,L,I,F);else if(C!=0)f(S.b,S.a,S.c,_,x,A,C,N,L,I,F);else if(L!=0)f(S.c,S.a,S.b,A,x,_,L,N,C,I,F);else return!0;return!1}function b(S,x,_,A){let v=x.degenerateSegment,M=S.plane.distanceToPoint(v.start),N=S.plane.distanceToPoint(v.end);return $n(M)?$n(N)?d(S,x,_,A):(_&&(_.start.copy(v.start),_.end.copy(v.start)),S.containsPoint(v.start)):$n(N)?(_&&(_.start.copy(v.end),_.end.copy(v.end)),S.containsPoint(v.end)):S.plane.intersectLine(v,n)!=null?(_&&(_.start.copy(n),_.end.copy(n)),S.containsPoint(n)):!1}function m(S,x,_){let A=x.a;return $n(S.plane.distanceToPoint(A))&&S.containsPoint(A)?(_&&(_.start.copy(A),_.end.copy(A)),!0):!1}function g(S,x,_){let A=S.degenerateSegment,v=x.a;return A.closestPointToPoint(v,!0,n),v.distanceToSquared(n)<O0?(_&&(_.start.copy(v),_.end.copy(v)),!0):!1}function w(S,x,_,A){if(S.isDegenerateIntoSegment)if(x.isDegenerateIntoSegment){let v=S.degenerateSegment,M=x.degenerateSegment,N=s,C=r;v.delta(N),M.delta(C);let L=n.subVectors(M.start,v.start),I=N.x*C.y-N.y*C.x;if($n(I))return!1;let F=(L.x*C.y-L.y*C.x)/I,k=-(N.x*L.y-N.y*L.x)/I;if(F<0||F>1||k<0||k>1)return!1;let B=v.start.z+N.z*F,G=M.start.z+C.z*k;return $n(B-G)?(_&&(_.start.copy(v.start).addScaledVector(N,F),_.end.copy(v.start).addScaledVector(N,F)),!0):!1}else return x.isDegenerateIntoPoint?g(S,x,_):b(x,S,_,A);else{if(S.isDegenerateIntoPoint)return x.isDegenerateIntoPoint?x.a.distanceToSquared(S.a)<O0?(_&&(_.start.copy(S.a),_.end.copy(S.a)),!0):!1:x.isDegenerateIntoSegment?g(x,S,_):m(x,S,_);if(x.isDegenerateIntoPoint)return m(S,x,_);if(x.isDegenerateIntoSegment)return b(S,x,_,A)}}return function(x,_=null,A=!1){this.needsUpdate&&this.update(),x.isExtendedTriangle?x.needsUpdate&&x.update():(i.copy(x),i.update(),x=i);let v=w(this,x,_,A);if(v!==void 0)return v;let M=this.plane,N=x.plane,C=N.distanceToPoint(this.a),L=N.distanceToPoint(this.b),I=N.distanceToPoint(this.c);$n(C)&&(C=0),$n(L)&&(L=0),$n(I)&&(I=0);let F=C*L,k=C*I;if(F>0&&k>0)return!1;let B=M.distanceToPoint(x.a),G=M.distanceToPoint(x.b),W=M.distanceToPoint(x.c);$n(B)&&(B=0),$n(G)&&(G=0),$n(W)&&(W=0);let et=B*G,X=B*W;if(et>0&&X>0)return!1;s.copy(M.normal),r.copy(N.normal);let Q=s.cross(r),tt=0,yt=Math.abs(Q.x),Nt=Math.abs(Q.y);Nt>yt&&(yt=Nt,tt=1),Math.abs(Q.z)>yt&&(tt=2);let ht=$T[tt],vt=this.a[ht],Ct=this.b[ht],pt=this.c[ht],Ft=x.a[ht],Te=x.b[ht],Pt=x.c[ht];if(p(this,vt,Ct,pt,F,k,C,L,I,h,a))return d(this,x,_,A);if(p(x,Ft,Te,Pt,et,X,B,G,W,u,l))return d(this,x,_,A);if(h.y<h.x){let jt=h.y;h.y=h.x,h.x=jt,c.copy(a.start),a.start.copy(a.end),a.end.copy(c)}if(u.y<u.x){let jt=u.y;u.y=u.x,u.x=jt,c.copy(l.start),l.start.copy(l.end),l.end.copy(c)}return h.y<u.x||u.y<h.x?!1:(_&&(u.x>h.x?_.start.copy(l.start):_.start.copy(a.start),u.y<h.y?_.end.copy(l.end):_.end.copy(a.end)),!0)}})();nn.prototype.distanceToPoint=(function(){let i=new P;return function(e){return this.closestPointToPoint(e,i),e.distanceTo(i)}})();nn.prototype.distanceToTriangle=(function(){let i=new P,t=new P,e=["a","b","c"],n=new Qe,s=new Qe;return function(o,a=null,l=null){let c=a||l?n:null;if(this.intersectsTriangle(o,c,!0))return(a||l)&&(a&&c.getCenter(a),l&&c.getCenter(l)),0;let h=1/0;for(let u=0;u<3;u++){let d,f=e[u],p=o[f];this.closestPointToPoint(p,i),d=p.distanceToSquared(i),d<h&&(h=d,a&&a.copy(i),l&&l.copy(p));let b=this[f];o.closestPointToPoint(b,i),d=b.distanceToSquared(i),d<h&&(h=d,a&&a.copy(b),l&&l.copy(i))}for(let u=0;u<3;u++){let d=e[u],f=e[(u+1)%3];n.set(this[d],this[f]);for(let p=0;p<3;p++){let b=e[p],m=e[(p+1)%3];s.set(o[b],o[m]),Ao(n,s,i,t);let g=i.distanceToSquared(t);g<h&&(h=g,a&&a.copy(i),l&&l.copy(t))}}return Math.sqrt(h)}})();var Ee=class{constructor(t,e,n){this.isOrientedBox=!0,this.min=new P,this.max=new P,this.matrix=new Mt,this.invMatrix=new Mt,this.points=new Array(8).fill().map(()=>new P),this.satAxes=new Array(3).fill().map(()=>new P),this.satBounds=new Array(3).fill().map(()=>new Dn),this.alignedSatBounds=new Array(3).fill().map(()=>new Dn),this.needsUpdate=!1,t&&this.min.copy(t),e&&this.max.copy(e),n&&this.matrix.copy(n)}set(t,e,n){this.min.copy(t),this.max.copy(e),this.matrix.copy(n),this.needsUpdate=!0}copy(t){this.min.copy(t.min),this.max.copy(t.max),this.matrix.copy(t.matrix),this.needsUpdate=!0}};Ee.prototype.update=(function(){return function(){let t=this.matrix,e=this.min,n=this.max,s=this.points;for(let c=0;c<=1;c++)for(let h=0;h<=1;h++)for(let u=0;u<=1;u++){let d=1*c|2*h|4*u,f=s[d];f.x=c?n.x:e.x,f.y=h?n.y:e.y,f.z=u?n.z:e.z,f.applyMatrix4(t)}let r=this.satBounds,o=this.satAxes,a=s[0];for(let c=0;c<3;c++){let h=o[c],u=r[c],d=1<<c,f=s[d];h.subVectors(a,f),u.setFromPoints(h,s)}let l=this.alignedSatBounds;l[0].setFromPointsField(s,"x"),l[1].setFromPointsField(s,"y"),l[2].setFromPointsField(s,"z"),this.invMatrix.copy(this.matrix).invert(),this.needsUpdate=!1}})();Ee.prototype.intersectsBox=(function(){let i=new Dn;return function(e){this.needsUpdate&&this.update();let n=e.min,s=e.max,r=this.satBounds,o=this.satAxes,a=this.alignedSatBounds;if(i.min=n.x,i.max=s.x,a[0].isSeparated(i)||(i.min=n.y,i.max=s.y,a[1].isSeparated(i))||(i.min=n.z,i.max=s.z,a[2].isSeparated(i)))return!1;for(let l=0;l<3;l++){let c=o[l],h=r[l];if(i.setFromBox(c,e),h.isSeparated(i))return!1}return!0}})();Ee.prototype.intersectsTriangle=(function(){let i=new nn,t=new Array(3),e=new Dn,n=new Dn,s=new P;return function(o){this.needsUpdate&&this.update(),o.isExtendedTriangle?o.needsUpdate&&o.update():(i.copy(o),i.update(),o=i);let a=this.satBounds,l=this.satAxes;t[0]=o.a,t[1]=o.b,t[2]=o.c;for(let d=0;d<3;d++){let f=a[d],p=l[d];if(e.setFromPoints(p,t),f.isSeparated(e))return!1}let c=o.satBounds,h=o.satAxes,u=this.points;for(let d=0;d<3;d++){let f=c[d],p=h[d];if(e.setFromPoints(p,u),f.isSeparated(e))return!1}for(let d=0;d<3;d++){let f=l[d];for(let p=0;p<4;p++){let b=h[p];if(s.crossVectors(f,b),e.setFromPoints(s,t),n.setFromPoints(s,u),e.isSeparated(n))return!1}}return!0}})();Ee.prototype.closestPointToPoint=(function(){return function(t,e){return this.needsUpdate&&this.update(),e.copy(t).applyMatrix4(this.invMatrix).clamp(this.min,this.max).applyMatrix4(this.matrix),e}})();Ee.prototype.distanceToPoint=(function(){let i=new P;return function(e){return this.closestPointToPoint(e,i),e.distanceTo(i)}})();Ee.prototype.distanceToBox=(function(){let i=["x","y","z"],t=new Array(12).fill().map(()=>new Qe),e=new Array(12).fill().map(()=>new Qe),n=new P,s=new P;return function(o,a=0,l=null,c=null){if(this.needsUpdate&&this.update(),this.intersectsBox(o))return(l||c)&&(o.getCenter(s),this.closestPointToPoint(s,n),o.closestPointToPoint(n,s),l&&l.copy(n),c&&c.copy(s)),0;let h=a*a,u=o.min,d=o.max,f=this.points,p=1/0;for(let m=0;m<8;m++){let g=f[m];s.copy(g).clamp(u,d);let w=g.distanceToSquared(s);if(w<p&&(p=w,l&&l.copy(g),c&&c.copy(s),w<h))return Math.sqrt(w)}let b=0;for(let m=0;m<3;m++)for(let g=0;g<=1;g++)for(let w=0;w<=1;w++){let S=(m+1)%3,x=(m+2)%3,_=g<<S|w<<x,A=1<<m|g<<S|w<<x,v=f[_],M=f[A];t[b].set(v,M);let C=i[m],L=i[S],I=i[x],F=e[b],k=F.start,B=F.end;k[C]=u[C],k[L]=g?u[L]:d[L],k[I]=w?u[I]:d[I],B[C]=d[C],B[L]=g?u[L]:d[L],B[I]=w?u[I]:d[I],b++}for(let m=0;m<=1;m++)for(let g=0;g<=1;g++)for(let w=0;w<=1;w++){s.x=m?d.x:u.x,s.y=g?d.y:u.y,s.z=w?d.z:u.z,this.closestPointToPoint(s,n);let S=s.distanceToSquared(n);if(S<p&&(p=S,l&&l.copy(n),c&&c.copy(s),S<h))return Math.sqrt(S)}for(let m=0;m<12;m++){let g=t[m];for(let w=0;w<12;w++){let S=e[w];Ao(g,S,n,s);let x=n.distanceToSquared(s);if(x<p&&(p=x,l&&l.copy(n),c&&c.copy(s),x<h))return Math.sqrt(x)}}return Math.sqrt(p)}})();var Pd=class extends es{constructor(){super(()=>new nn)}},vn=new Pd;var Co=new P,Rd=new P;function F0(i,t,e={},n=0,s=1/0){let r=n*n,o=s*s,a=1/0,l=null;if(i.shapecast({boundsTraverseOrder:h=>(Co.copy(t).clamp(h.min,h.max),Co.distanceToSquared(t)),intersectsBounds:(h,u,d)=>d<a&&d<o,intersectsTriangle:(h,u)=>{h.closestPointToPoint(t,Co);let d=t.distanceToSquared(Co);return d<a&&(Rd.copy(Co),a=d,l=u),d<r}}),a===1/0)return null;let c=Math.sqrt(a);return e.point?e.point.copy(Rd):e.point=Rd.clone(),e.distance=c,e.faceIndex=l,e}var Fc=parseInt("187")>=169,XT=parseInt("187")<=161,Ss=new P,Ms=new P,Ts=new P,Uc=new Et,Bc=new Et,zc=new Et,U0=new P,B0=new P,z0=new P,Po=new P;function qT(i,t,e,n,s,r,o,a){let l;if(r===tn?l=i.intersectTriangle(n,e,t,!0,s):l=i.intersectTriangle(t,e,n,r!==Oe,s),l===null)return null;let c=i.origin.distanceTo(s);return c<o||c>a?null:{distance:c,point:s.clone()}}function V0(i,t,e,n,s,r,o,a,l,c,h){Ss.fromBufferAttribute(t,r),Ms.fromBufferAttribute(t,o),Ts.fromBufferAttribute(t,a);let u=qT(i,Ss,Ms,Ts,Po,l,c,h);if(u){if(n){Uc.fromBufferAttribute(n,r),Bc.fromBufferAttribute(n,o),zc.fromBufferAttribute(n,a),u.uv=new Et;let f=cn.getInterpolation(Po,Ss,Ms,Ts,Uc,Bc,zc,u.uv);Fc||(u.uv=f)}if(s){Uc.fromBufferAttribute(s,r),Bc.fromBufferAttribute(s,o),zc.fromBufferAttribute(s,a),u.uv1=new Et;let f=cn.getInterpolation(Po,Ss,Ms,Ts,Uc,Bc,zc,u.uv1);Fc||(u.uv1=f),XT&&(u.uv2=u.uv1)}if(e){U0.fromBufferAttribute(e,r),B0.fromBufferAttribute(e,o),z0.fromBufferAttribute(e,a),u.normal=new P;let f=cn.getInterpolation(Po,Ss,Ms,Ts,U0,B0,z0,u.normal);u.normal.dot(i.direction)>0&&u.normal.multiplyScalar(-1),Fc||(u.normal=f)}let d={a:r,b:o,c:a,normal:new P,materialIndex:0};if(cn.getNormal(Ss,Ms,Ts,d.normal),u.face=d,u.faceIndex=r,Fc){let f=new P;cn.getBarycoord(Po,Ss,Ms,Ts,f),u.barycoord=f}}return u}function H0(i){return i&&i.isMaterial?i.side:i}function wr(i,t,e,n,s,r,o){let a=n*3,l=a+0,c=a+1,h=a+2,{index:u,groups:d}=i;i.index&&(l=u.getX(l),c=u.getX(c),h=u.getX(h));let{position:f,normal:p,uv:b,uv1:m}=i.attributes;if(Array.isArray(t)){let g=n*3;for(let w=0,S=d.length;w<S;w++){let{start:x,count:_,materialIndex:A}=d[w];if(g>=x&&g<x+_){let v=H0(t[A]),M=V0(e,f,p,b,m,l,c,h,v,r,o);if(M)if(M.faceIndex=n,M.face.materialIndex=A,s)s.push(M);else return M}}}else{let g=H0(t),w=V0(e,f,p,b,m,l,c,h,g,r,o);if(w)if(w.faceIndex=n,w.face.materialIndex=0,s)s.push(w);else return w}return null}function pe(i,t,e,n){let s=i.a,r=i.b,o=i.c,a=t,l=t+1,c=t+2;e&&(a=e.getX(a),l=e.getX(l),c=e.getX(c)),s.x=n.getX(a),s.y=n.getY(a),s.z=n.getZ(a),r.x=n.getX(l),r.y=n.getY(l),r.z=n.getZ(l),o.x=n.getX(c),o.y=n.getY(c),o.z=n.getZ(c)}function G0(i,t,e,n,s,r,o,a){let{geometry:l,_indirectBuffer:c}=i;for(let h=n,u=n+s;h<u;h++)wr(l,t,e,h,r,o,a)}function W0(i,t,e,n,s,r,o){let{geometry:a,_indirectBuffer:l}=i,c=1/0,h=null;for(let u=n,d=n+s;u<d;u++){let f;f=wr(a,t,e,u,null,r,o),f&&f.distance<c&&(h=f,c=f.distance)}return h}function $0(i,t,e,n,s,r,o){let{geometry:a}=e,{index:l}=a,c=a.attributes.position;for(let h=i,u=t+i;h<u;h++){let d;if(d=h,pe(o,d*3,l,c),o.needsUpdate=!0,n(o,d,s,r))return!0}return!1}function X0(i,t=null){t&&Array.isArray(t)&&(t=new Set(t));let e=i.geometry,n=e.index?e.index.array:null,s=e.attributes.position,r,o,a,l,c=0,h=i._roots;for(let d=0,f=h.length;d<f;d++)r=h[d],o=new Uint32Array(r),a=new Uint16Array(r),l=new Float32Array(r),u(0,c),c+=r.byteLength;function u(d,f,p=!1){let b=d*2;if(Kt(b,a)){let m=oe(d,o),g=ce(b,a),w=1/0,S=1/0,x=1/0,_=-1/0,A=-1/0,v=-1/0;for(let M=3*m,N=3*(m+g);M<N;M++){let C=n[M],L=s.getX(C),I=s.getY(C),F=s.getZ(C);L<w&&(w=L),L>_&&(_=L),I<S&&(S=I),I>A&&(A=I),F<x&&(x=F),F>v&&(v=F)}return l[d+0]!==w||l[d+1]!==S||l[d+2]!==x||l[d+3]!==_||l[d+4]!==A||l[d+5]!==v?(l[d+0]=w,l[d+1]=S,l[d+2]=x,l[d+3]=_,l[d+4]=A,l[d+5]=v,!0):!1}else{let m=ne(d),g=ie(d,o),w=p,S=!1,x=!1;if(t){if(!w){let C=m/8+f/32,L=g/8+f/32;S=t.has(C),x=t.has(L),w=!S&&!x}}else S=!0,x=!0;let _=w||S,A=w||x,v=!1;_&&(v=u(m,f,w));let M=!1;A&&(M=u(g,f,w));let N=v||M;if(N)for(let C=0;C<3;C++){let L=m+C,I=g+C,F=l[L],k=l[L+3],B=l[I],G=l[I+3];l[d+C]=F<B?F:B,l[d+C+3]=k>G?k:G}return N}}}function dn(i,t,e,n,s){let r,o,a,l,c,h,u=1/e.direction.x,d=1/e.direction.y,f=1/e.direction.z,p=e.origin.x,b=e.origin.y,m=e.origin.z,g=t[i],w=t[i+3],S=t[i+1],x=t[i+3+1],_=t[i+2],A=t[i+3+2];return u>=0?(r=(g-p)*u,o=(w-p)*u):(r=(w-p)*u,o=(g-p)*u),d>=0?(a=(S-b)*d,l=(x-b)*d):(a=(x-b)*d,l=(S-b)*d),r>l||a>o||((a>r||isNaN(r))&&(r=a),(l<o||isNaN(o))&&(o=l),f>=0?(c=(_-m)*f,h=(A-m)*f):(c=(A-m)*f,h=(_-m)*f),r>h||c>o)?!1:((c>r||r!==r)&&(r=c),(h<o||o!==o)&&(o=h),r<=s&&o>=n)}function q0(i,t,e,n,s,r,o,a){let{geometry:l,_indirectBuffer:c}=i;for(let h=n,u=n+s;h<u;h++){let d=c?c[h]:h;wr(l,t,e,d,r,o,a)}}function Y0(i,t,e,n,s,r,o){let{geometry:a,_indirectBuffer:l}=i,c=1/0,h=null;for(let u=n,d=n+s;u<d;u++){let f;f=wr(a,t,e,l?l[u]:u,null,r,o),f&&f.distance<c&&(h=f,c=f.distance)}return h}function Z0(i,t,e,n,s,r,o){let{geometry:a}=e,{index:l}=a,c=a.attributes.position;for(let h=i,u=t+i;h<u;h++){let d;if(d=e.resolveTriangleIndex(h),pe(o,d*3,l,c),o.needsUpdate=!0,n(o,d,s,r))return!0}return!1}function J0(i,t,e,n,s,r,o){Xt.setBuffer(i._roots[t]),dn(0,Xt.float32Array,n,r,o)&&Ld(0,i,e,n,s,r,o),Xt.clearBuffer()}function Ld(i,t,e,n,s,r,o){let{float32Array:a,uint16Array:l,uint32Array:c}=Xt,h=i*2;if(Kt(h,l)){let d=oe(i,c),f=ce(h,l);G0(t,e,n,d,f,s,r,o)}else{let d=ne(i);dn(d,a,n,r,o)&&Ld(d,t,e,n,s,r,o);let f=ie(i,c);dn(f,a,n,r,o)&&Ld(f,t,e,n,s,r,o)}}var YT=["x","y","z"];function K0(i,t,e,n,s,r){Xt.setBuffer(i._roots[t]);let o=null;return dn(0,Xt.float32Array,n,s,r)&&(o=Id(0,i,e,n,s,r)),Xt.clearBuffer(),o}function Id(i,t,e,n,s,r){let{float32Array:o,uint16Array:a,uint32Array:l}=Xt,c=i*2;if(Kt(c,a)){let u=oe(i,l),d=ce(c,a);return W0(t,e,n,u,d,s,r)}else{let u=fr(i,l),d=YT[u],p=n.direction[d]>=0,b,m;p?(b=ne(i),m=ie(i,l)):(b=ie(i,l),m=ne(i));let w=dn(b,o,n,s,r)?Id(b,t,e,n,s,r):null;if(w){let _=w.point[d];if(p?_<=o[m+u]:_>=o[m+u+3])return w}let x=dn(m,o,n,s,r)?Id(m,t,e,n,s,r):null;return w&&x?w.distance<=x.distance?w:x:w||x||null}}var Vc=new le,_r=new nn,Sr=new nn,Ro=new Mt,j0=new Ee,Hc=new Ee;function Q0(i,t,e,n){Xt.setBuffer(i._roots[t]);let s=kd(0,i,e,n);return Xt.clearBuffer(),s}function kd(i,t,e,n,s=null){let{float32Array:r,uint16Array:o,uint32Array:a}=Xt,l=i*2;if(s===null&&(e.boundingBox||e.computeBoundingBox(),j0.set(e.boundingBox.min,e.boundingBox.max,n),s=j0),Kt(l,o)){let h=t.geometry,u=h.index,d=h.attributes.position,f=e.index,p=e.attributes.position,b=oe(i,a),m=ce(l,o);if(Ro.copy(n).invert(),e.boundsTree)return fe(i,r,Hc),Hc.matrix.copy(Ro),Hc.needsUpdate=!0,e.boundsTree.shapecast({intersectsBounds:w=>Hc.intersectsBox(w),intersectsTriangle:w=>{w.a.applyMatrix4(n),w.b.applyMatrix4(n),w.c.applyMatrix4(n),w.needsUpdate=!0;for(let S=b*3,x=(m+b)*3;S<x;S+=3)if(pe(Sr,S,u,d),Sr.needsUpdate=!0,w.intersectsTriangle(Sr))return!0;return!1}});{let g=ss(e);for(let w=b*3,S=(m+b)*3;w<S;w+=3){pe(_r,w,u,d),_r.a.applyMatrix4(Ro),_r.b.applyMatrix4(Ro),_r.c.applyMatrix4(Ro),_r.needsUpdate=!0;for(let x=0,_=g*3;x<_;x+=3)if(pe(Sr,x,f,p),Sr.needsUpdate=!0,_r.intersectsTriangle(Sr))return!0}}}else{let h=ne(i),u=ie(i,a);return fe(h,r,Vc),!!(s.intersectsBox(Vc)&&kd(h,t,e,n,s)||(fe(u,r,Vc),s.intersectsBox(Vc)&&kd(u,t,e,n,s)))}}var Gc=new Mt,Nd=new Ee,Lo=new Ee,ZT=new P,JT=new P,KT=new P,jT=new P;function tx(i,t,e,n={},s={},r=0,o=1/0){t.boundingBox||t.computeBoundingBox(),Nd.set(t.boundingBox.min,t.boundingBox.max,e),Nd.needsUpdate=!0;let a=i.geometry,l=a.attributes.position,c=a.index,h=t.attributes.position,u=t.index,d=vn.getPrimitive(),f=vn.getPrimitive(),p=ZT,b=JT,m=null,g=null;s&&(m=KT,g=jT);let w=1/0,S=null,x=null;return Gc.copy(e).invert(),Lo.matrix.copy(Gc),i.shapecast({boundsTraverseOrder:_=>Nd.distanceToBox(_),intersectsBounds:(_,A,v)=>v<w&&v<o?(A&&(Lo.min.copy(_.min),Lo.max.copy(_.max),Lo.needsUpdate=!0),!0):!1,intersectsRange:(_,A)=>{if(t.boundsTree)return t.boundsTree.shapecast({boundsTraverseOrder:M=>Lo.distanceToBox(M),intersectsBounds:(M,N,C)=>C<w&&C<o,intersectsRange:(M,N)=>{for(let C=M,L=M+N;C<L;C++){pe(f,3*C,u,h),f.a.applyMatrix4(e),f.b.applyMatrix4(e),f.c.applyMatrix4(e),f.needsUpdate=!0;for(let I=_,F=_+A;I<F;I++){pe(d,3*I,c,l),d.needsUpdate=!0;let k=d.distanceToTriangle(f,p,m);if(k<w&&(b.copy(p),g&&g.copy(m),w=k,S=I,x=C),k<r)return!0}}}});{let v=ss(t);for(let M=0,N=v;M<N;M++){pe(f,3*M,u,h),f.a.applyMatrix4(e),f.b.applyMatrix4(e),f.c.applyMatrix4(e),f.needsUpdate=!0;for(let C=_,L=_+A;C<L;C++){pe(d,3*C,c,l),d.needsUpdate=!0;let I=d.distanceToTriangle(f,p,m);if(I<w&&(b.copy(p),g&&g.copy(m),w=I,S=C,x=M),I<r)return!0}}}}}),vn.releasePrimitive(d),vn.releasePrimitive(f),w===1/0?null:(n.point?n.point.copy(b):n.point=b.clone(),n.distance=w,n.faceIndex=S,s&&(s.point?s.point.copy(g):s.point=g.clone(),s.point.applyMatrix4(Gc),b.applyMatrix4(Gc),s.distance=b.sub(s.point).length(),s.faceIndex=x),n)}function ex(i,t=null){t&&Array.isArray(t)&&(t=new Set(t));let e=i.geometry,n=e.index?e.index.array:null,s=e.attributes.position,r,o,a,l,c=0,h=i._roots;for(let d=0,f=h.length;d<f;d++)r=h[d],o=new Uint32Array(r),a=new Uint16Array(r),l=new Float32Array(r),u(0,c),c+=r.byteLength;function u(d,f,p=!1){let b=d*2;if(Kt(b,a)){let m=oe(d,o),g=ce(b,a),w=1/0,S=1/0,x=1/0,_=-1/0,A=-1/0,v=-1/0;for(let M=m,N=m+g;M<N;M++){let C=3*i.resolveTriangleIndex(M);for(let L=0;L<3;L++){let I=C+L;I=n?n[I]:I;let F=s.getX(I),k=s.getY(I),B=s.getZ(I);F<w&&(w=F),F>_&&(_=F),k<S&&(S=k),k>A&&(A=k),B<x&&(x=B),B>v&&(v=B)}}return l[d+0]!==w||l[d+1]!==S||l[d+2]!==x||l[d+3]!==_||l[d+4]!==A||l[d+5]!==v?(l[d+0]=w,l[d+1]=S,l[d+2]=x,l[d+3]=_,l[d+4]=A,l[d+5]=v,!0):!1}else{let m=ne(d),g=ie(d,o),w=p,S=!1,x=!1;if(t){if(!w){let C=m/8+f/32,L=g/8+f/32;S=t.has(C),x=t.has(L),w=!S&&!x}}else S=!0,x=!0;let _=w||S,A=w||x,v=!1;_&&(v=u(m,f,w));let M=!1;A&&(M=u(g,f,w));let N=v||M;if(N)for(let C=0;C<3;C++){let L=m+C,I=g+C,F=l[L],k=l[L+3],B=l[I],G=l[I+3];l[d+C]=F<B?F:B,l[d+C+3]=k>G?k:G}return N}}}function nx(i,t,e,n,s,r,o){Xt.setBuffer(i._roots[t]),dn(0,Xt.float32Array,n,r,o)&&Dd(0,i,e,n,s,r,o),Xt.clearBuffer()}function Dd(i,t,e,n,s,r,o){let{float32Array:a,uint16Array:l,uint32Array:c}=Xt,h=i*2;if(Kt(h,l)){let d=oe(i,c),f=ce(h,l);q0(t,e,n,d,f,s,r,o)}else{let d=ne(i);dn(d,a,n,r,o)&&Dd(d,t,e,n,s,r,o);let f=ie(i,c);dn(f,a,n,r,o)&&Dd(f,t,e,n,s,r,o)}}var QT=["x","y","z"];function ix(i,t,e,n,s,r){Xt.setBuffer(i._roots[t]);let o=null;return dn(0,Xt.float32Array,n,s,r)&&(o=Od(0,i,e,n,s,r)),Xt.clearBuffer(),o}function Od(i,t,e,n,s,r){let{float32Array:o,uint16Array:a,uint32Array:l}=Xt,c=i*2;if(Kt(c,a)){let u=oe(i,l),d=ce(c,a);return Y0(t,e,n,u,d,s,r)}else{let u=fr(i,l),d=QT[u],p=n.direction[d]>=0,b,m;p?(b=ne(i),m=ie(i,l)):(b=ie(i,l),m=ne(i));let w=dn(b,o,n,s,r)?Od(b,t,e,n,s,r):null;if(w){let _=w.point[d];if(p?_<=o[m+u]:_>=o[m+u+3])return w}let x=dn(m,o,n,s,r)?Od(m,t,e,n,s,r):null;return w&&x?w.distance<=x.distance?w:x:w||x||null}}var Wc=new le,Mr=new nn,Tr=new nn,Io=new Mt,sx=new Ee,$c=new Ee;function rx(i,t,e,n){Xt.setBuffer(i._roots[t]);let s=Fd(0,i,e,n);return Xt.clearBuffer(),s}function Fd(i,t,e,n,s=null){let{float32Array:r,uint16Array:o,uint32Array:a}=Xt,l=i*2;if(s===null&&(e.boundingBox||e.computeBoundingBox(),sx.set(e.boundingBox.min,e.boundingBox.max,n),s=sx),Kt(l,o)){let h=t.geometry,u=h.index,d=h.attributes.position,f=e.index,p=e.attributes.position,b=oe(i,a),m=ce(l,o);if(Io.copy(n).invert(),e.boundsTree)return fe(i,r,$c),$c.matrix.copy(Io),$c.needsUpdate=!0,e.boundsTree.shapecast({intersectsBounds:w=>$c.intersectsBox(w),intersectsTriangle:w=>{w.a.applyMatrix4(n),w.b.applyMatrix4(n),w.c.applyMatrix4(n),w.needsUpdate=!0;for(let S=b,x=m+b;S<x;S++)if(pe(Tr,3*t.resolveTriangleIndex(S),u,d),Tr.needsUpdate=!0,w.intersectsTriangle(Tr))return!0;return!1}});{let g=ss(e);for(let w=b,S=m+b;w<S;w++){let x=t.resolveTriangleIndex(w);pe(Mr,3*x,u,d),Mr.a.applyMatrix4(Io),Mr.b.applyMatrix4(Io),Mr.c.applyMatrix4(Io),Mr.needsUpdate=!0;for(let _=0,A=g*3;_<A;_+=3)if(pe(Tr,_,f,p),Tr.needsUpdate=!0,Mr.intersectsTriangle(Tr))return!0}}}else{let h=ne(i),u=ie(i,a);return fe(h,r,Wc),!!(s.intersectsBox(Wc)&&Fd(h,t,e,n,s)||(fe(u,r,Wc),s.intersectsBox(Wc)&&Fd(u,t,e,n,s)))}}var Xc=new Mt,Ud=new Ee,ko=new Ee,tE=new P,eE=new P,nE=new P,iE=new P;function ox(i,t,e,n={},s={},r=0,o=1/0){t.boundingBox||t.computeBoundingBox(),Ud.set(t.boundingBox.min,t.boundingBox.max,e),Ud.needsUpdate=!0;let a=i.geometry,l=a.attributes.position,c=a.index,h=t.attributes.position,u=t.index,d=vn.getPrimitive(),f=vn.getPrimitive(),p=tE,b=eE,m=null,g=null;s&&(m=nE,g=iE);let w=1/0,S=null,x=null;return Xc.copy(e).invert(),ko.matrix.copy(Xc),i.shapecast({boundsTraverseOrder:_=>Ud.distanceToBox(_),intersectsBounds:(_,A,v)=>v<w&&v<o?(A&&(ko.min.copy(_.min),ko.max.copy(_.max),ko.needsUpdate=!0),!0):!1,intersectsRange:(_,A)=>{if(t.boundsTree){let v=t.boundsTree;return v.shapecast({boundsTraverseOrder:M=>ko.distanceToBox(M),intersectsBounds:(M,N,C)=>C<w&&C<o,intersectsRange:(M,N)=>{for(let C=M,L=M+N;C<L;C++){let I=v.resolveTriangleIndex(C);pe(f,3*I,u,h),f.a.applyMatrix4(e),f.b.applyMatrix4(e),f.c.applyMatrix4(e),f.needsUpdate=!0;for(let F=_,k=_+A;F<k;F++){let B=i.resolveTriangleIndex(F);pe(d,3*B,c,l),d.needsUpdate=!0;let G=d.distanceToTriangle(f,p,m);if(G<w&&(b.copy(p),g&&g.copy(m),w=G,S=F,x=C),G<r)return!0}}}})}else{let v=ss(t);for(let M=0,N=v;M<N;M++){pe(f,3*M,u,h),f.a.applyMatrix4(e),f.b.applyMatrix4(e),f.c.applyMatrix4(e),f.needsUpdate=!0;for(let C=_,L=_+A;C<L;C++){let I=i.resolveTriangleIndex(C);pe(d,3*I,c,l),d.needsUpdate=!0;let F=d.distanceToTriangle(f,p,m);if(F<w&&(b.copy(p),g&&g.copy(m),w=F,S=C,x=M),F<r)return!0}}}}}),vn.releasePrimitive(d),vn.releasePrimitive(f),w===1/0?null:(n.point?n.point.copy(b):n.point=b.clone(),n.distance=w,n.faceIndex=S,s&&(s.point?s.point.copy(g):s.point=g.clone(),s.point.applyMatrix4(Xc),b.applyMatrix4(Xc),s.distance=b.sub(s.point).length(),s.faceIndex=x),n)}function Bd(i,t,e){return i===null?null:(i.point.applyMatrix4(t.matrixWorld),i.distance=i.point.distanceTo(e.ray.origin),i.object=t,i)}var qc=new Ee,Yc=new Wi,ax=new P,lx=new Mt,cx=new P,zd=["getX","getY","getZ"],Zc=class i extends Oc{static serialize(t,e={}){e={cloneBuffers:!0,...e};let n=t.geometry,s=t._roots,r=t._indirectBuffer,o=n.getIndex(),a={version:1,roots:null,index:null,indirectBuffer:null};return e.cloneBuffers?(a.roots=s.map(l=>l.slice()),a.index=o?o.array.slice():null,a.indirectBuffer=r?r.slice():null):(a.roots=s,a.index=o?o.array:null,a.indirectBuffer=r),a}static deserialize(t,e,n={}){n={setIndex:!0,indirect:!!t.indirectBuffer,...n};let{index:s,roots:r,indirectBuffer:o}=t;t.version||(console.warn("MeshBVH.deserialize: Serialization format has been changed and will be fixed up. It is recommended to regenerate any stored serialized data."),l(r));let a=new i(e,{...n,[Mo]:!0});if(a._roots=r,a._indirectBuffer=o||null,n.setIndex){let c=e.getIndex();if(c===null){let h=new be(t.index,1,!1);e.setIndex(h)}else c.array!==s&&(c.array.set(s),c.needsUpdate=!0)}return a;function l(c){for(let h=0;h<c.length;h++){let u=c[h],d=new Uint32Array(u),f=new Uint16Array(u);for(let p=0,b=u.byteLength/32;p<b;p++){let m=8*p,g=2*m;Kt(g,f)||(d[m+6]=d[m+6]/8-p)}}}}get primitiveStride(){return 3}get resolveTriangleIndex(){return this.resolvePrimitiveIndex}constructor(t,e={}){e.maxLeafTris&&(console.warn('MeshBVH: "maxLeafTris" option has been deprecated. Use "targetLeafSize", instead.'),e={...e,targetLeafSize:e.maxLeafTris}),super(t,e)}shiftTriangleOffsets(t){return super.shiftPrimitiveOffsets(t)}writePrimitiveBounds(t,e,n){let s=this.geometry,r=this._indirectBuffer,o=s.attributes.position,a=s.index?s.index.array:null,c=(r?r[t]:t)*3,h=c+0,u=c+1,d=c+2;a&&(h=a[h],u=a[u],d=a[d]);for(let f=0;f<3;f++){let p=o[zd[f]](h),b=o[zd[f]](u),m=o[zd[f]](d),g=p;b<g&&(g=b),m<g&&(g=m);let w=p;b>w&&(w=b),m>w&&(w=m),e[n+f]=g,e[n+f+3]=w}return e}computePrimitiveBounds(t,e,n){let s=this.geometry,r=this._indirectBuffer,o=s.attributes.position,a=s.index?s.index.array:null,l=o.normalized;if(t<0||e+t-n.offset>n.length/6)throw new Error("MeshBVH: compute triangle bounds range is invalid.");let c=o.array,h=o.offset||0,u=3;o.isInterleavedBufferAttribute&&(u=o.data.stride);let d=["getX","getY","getZ"],f=n.offset;for(let p=t,b=t+e;p<b;p++){let g=(r?r[p]:p)*3,w=(p-f)*6,S=g+0,x=g+1,_=g+2;a&&(S=a[S],x=a[x],_=a[_]),l||(S=S*u+h,x=x*u+h,_=_*u+h);for(let A=0;A<3;A++){let v,M,N;l?(v=o[d[A]](S),M=o[d[A]](x),N=o[d[A]](_)):(v=c[S+A],M=c[x+A],N=c[_+A]);let C=v;M<C&&(C=M),N<C&&(C=N);let L=v;M>L&&(L=M),N>L&&(L=N);let I=(L-C)/2,F=A*2;n[w+F+0]=C+I,n[w+F+1]=I+(Math.abs(C)+I)*dr}}return n}raycastObject3D(t,e,n=[]){let{material:s}=t;if(s===void 0)return;lx.copy(t.matrixWorld).invert(),Yc.copy(e.ray).applyMatrix4(lx),cx.setFromMatrixScale(t.matrixWorld),ax.copy(Yc.direction).multiply(cx);let r=ax.length(),o=e.near/r,a=e.far/r;if(e.firstHitOnly===!0){let l=this.raycastFirst(Yc,s,o,a);l=Bd(l,t,e),l&&n.push(l)}else{let l=this.raycast(Yc,s,o,a);for(let c=0,h=l.length;c<h;c++){let u=Bd(l[c],t,e);u&&n.push(u)}}return n}refit(t=null){return(this.indirect?ex:X0)(this,t)}raycast(t,e=jn,n=0,s=1/0){let r=this._roots,o=[],a=this.indirect?nx:J0;for(let l=0,c=r.length;l<c;l++)a(this,l,e,t,o,n,s);return o}raycastFirst(t,e=jn,n=0,s=1/0){let r=this._roots,o=null,a=this.indirect?ix:K0;for(let l=0,c=r.length;l<c;l++){let h=a(this,l,e,t,n,s);h!=null&&(o==null||h.distance<o.distance)&&(o=h)}return o}intersectsGeometry(t,e){let n=!1,s=this._roots,r=this.indirect?rx:Q0;for(let o=0,a=s.length;o<a&&(n=r(this,o,t,e),!n);o++);return n}shapecast(t){let e=vn.getPrimitive(),n=super.shapecast({...t,intersectsPrimitive:t.intersectsTriangle,scratchPrimitive:e,iterate:this.indirect?Z0:$0});return vn.releasePrimitive(e),n}bvhcast(t,e,n){let{intersectsRanges:s,intersectsTriangles:r}=n,o=vn.getPrimitive(),a=this.geometry.index,l=this.geometry.attributes.position,c=this.indirect?p=>{let b=this.resolveTriangleIndex(p);pe(o,b*3,a,l)}:p=>{pe(o,p*3,a,l)},h=vn.getPrimitive(),u=t.geometry.index,d=t.geometry.attributes.position,f=t.indirect?p=>{let b=t.resolveTriangleIndex(p);pe(h,b*3,u,d)}:p=>{pe(h,p*3,u,d)};if(r){if(!(t instanceof i))throw new Error('MeshBVH: "intersectsTriangles" callback can only be used with another MeshBVH.');let p=(b,m,g,w,S,x,_,A)=>{for(let v=g,M=g+w;v<M;v++){f(v),h.a.applyMatrix4(e),h.b.applyMatrix4(e),h.c.applyMatrix4(e),h.needsUpdate=!0;for(let N=b,C=b+m;N<C;N++)if(c(N),o.needsUpdate=!0,r(o,h,N,v,S,x,_,A))return!0}return!1};if(s){let b=s;s=function(m,g,w,S,x,_,A,v){return b(m,g,w,S,x,_,A,v)?!0:p(m,g,w,S,x,_,A,v)}}else s=p}return super.bvhcast(t,e,{intersectsRanges:s})}intersectsBox(t,e){return qc.set(t.min,t.max,e),qc.needsUpdate=!0,this.shapecast({intersectsBounds:n=>qc.intersectsBox(n),intersectsTriangle:n=>qc.intersectsTriangle(n)})}intersectsSphere(t){return this.shapecast({intersectsBounds:e=>t.intersectsBox(e),intersectsTriangle:e=>e.intersectsSphere(t)})}closestPointToGeometry(t,e,n={},s={},r=0,o=1/0){return(this.indirect?ox:tx)(this,t,e,n,s,r,o)}closestPointToPoint(t,e={},n=0,s=1/0){return F0(this,t,e,n,s)}};var sE=48,Jc=class{kept=new Map;plant;culling;constructor(t,e){this.plant=t,this.culling=e}hit(t,e,n){let s=this.culling.formOf(t);if(!s)return null;let r=this.treeOf(s.batch,s.instance),o=this.plant.matrixOf(t,new Mt),a=e.clone().applyMatrix4(o.clone().invert()),l=null,c=1/0;for(let h of r.raycast(a,Oe)){if(h.distance>=c||!h.face)continue;let u=h.point.clone().applyMatrix4(o);if(n&&n.x*u.x+n.y*u.y+n.z*u.z>n.w)continue;c=h.distance;let d=this.cornersOf(r,h.face,o),f=new P().subVectors(d[1],d[0]).cross(new P().subVectors(d[2],d[0])).normalize();f.dot(e.direction)>0&&f.negate(),l={mesh:t,point:u,normal:f,corners:d}}return l}cornersOf(t,e,n){let s=t.geometry.getAttribute("position"),r=o=>new P().fromBufferAttribute(s,o).applyMatrix4(n);return[r(e.a),r(e.b),r(e.c)]}treeOf(t,e){let n=t.rangeAt(e),s=this.kept.get(n);if(s)return this.kept.delete(n),this.kept.set(n,s),s;let r=t.object.geometry.getAttribute("position").array,o=t.object.geometry.getIndex().array,a=new Float32Array(3*n.vertexCount);for(let u=0;u<a.length;u++)a[u]=n.low[u%3]+n.step[u%3]*r[3*n.vertexStart+u];let l=new Uint32Array(n.indexCount);for(let u=0;u<l.length;u++)l[u]=o[n.indexStart+u]-n.vertexStart;let c=new Le;c.setAttribute("position",new be(a,3)),c.setIndex(new be(l,1));let h=new Zc(c);return this.kept.set(n,h),this.kept.size>sE&&this.kept.delete(this.kept.keys().next().value),h}};var hx=36,rE=4294967295,Kc=class{start;items;constructor(t,e){this.start=new Uint32Array(e+1);for(let s=0;s<t.length;s++)t[s]>=0&&t[s]<e&&this.start[t[s]+1]++;for(let s=0;s<e;s++)this.start[s+1]+=this.start[s];this.items=new Uint32Array(this.start[e]);let n=this.start.slice();for(let s=0;s<t.length;s++)t[s]>=0&&t[s]<e&&(this.items[n[t[s]]++]=s)}of(t){return this.items.subarray(this.start[t]??0,this.start[t+1]??0)}},jc=class{n;shapeOf;partOf;color;center;radius;offset;meshesOfShape;meshesOfPart;quaternion;shift;turn=new Gn;place=new P;size=new P;whole=new P(1,1,1);constructor(t,e,n){let s=Math.min(t.n_meshes,Math.floor(e.byteLength/hx)),r=new DataView(e);this.n=s,this.shapeOf=new Int32Array(s),this.partOf=Int32Array.from({length:s},(o,a)=>n.meshes.part[a]??-1),this.color=new Uint8Array(4*s),this.quaternion=new Float32Array(4*s),this.shift=new Float32Array(3*s),this.center=new Float32Array(3*s),this.radius=new Float32Array(s),this.offset=new Float32Array(3*s);for(let o=0;o<s;o++){let a=o*hx,l=r.getUint32(a,!0);this.shapeOf[o]=l===rE?-1:l;for(let c=0;c<4;c++)this.color[4*o+c]=r.getUint8(a+4+c);for(let c=0;c<4;c++)this.quaternion[4*o+c]=r.getFloat32(a+8+4*c,!0);for(let c=0;c<3;c++)this.shift[3*o+c]=r.getFloat32(a+24+4*c,!0)}this.meshesOfShape=new Kc(this.shapeOf,t.n_shapes),this.meshesOfPart=new Kc(this.partOf,n.parts.id.length)}matrixOf(t,e,n=!1){return this.turn.fromArray(this.quaternion,4*t),this.place.fromArray(this.shift,3*t),n||(this.place.x+=this.offset[3*t],this.place.y+=this.offset[3*t+1],this.place.z+=this.offset[3*t+2]),e.compose(this.place,this.turn,this.whole)}setBounds(t,e,n){let s=new Mt,r=new P,o=this.size.set(n[0]-e[0],n[1]-e[1],n[2]-e[2]).length()/2;for(let a of this.meshesOfShape.of(t))r.set((e[0]+n[0])/2,(e[1]+n[1])/2,(e[2]+n[2])/2),r.applyMatrix4(this.matrixOf(a,s,!0)).toArray(this.center,3*a),this.radius[a]=Math.max(o,1e-6)}ballOf(t){let e=[1/0,1/0,1/0],n=[-1/0,-1/0,-1/0];for(let r of t){let o=this.radius[r];if(o)for(let a=0;a<3;a++){let l=this.center[3*r+a]+this.offset[3*r+a];e[a]=Math.min(e[a],l-o),n[a]=Math.max(n[a],l+o)}}return e[0]>n[0]?null:{center:[(e[0]+n[0])/2,(e[1]+n[1])/2,(e[2]+n[2])/2],radius:Math.hypot(n[0]-e[0],n[1]-e[1],n[2]-e[2])/2}}};var Qc=class{frameMs=0;budget;scale=1;stillMs=0;last=-1/0;software;constructor(t){this.software=t,this.budget=t?4e5:6e6,t&&(this.scale=.6)}get slow(){return this.software||this.frameMs>150}get samples(){let t=this.software?4:12;return this.stillMs?Math.max(2,Math.min(t,Math.round(1200/this.stillMs))):t}get leastPixels(){return this.scale<1?5:2}frame(t,e){let n=t-this.last;if(this.last=t,!(n<=0||n>5e3)){if(!e){this.stillMs=this.stillMs?.5*this.stillMs+.5*n:n;return}n>2e3||(this.frameMs=this.frameMs?.7*this.frameMs+.3*n:n,this.frameMs>1.3*40?this.slower():this.frameMs<.7*40&&this.faster())}}slower(){this.budget=Math.max(6e4,this.budget*.85),this.budget<3e5&&(this.scale=Math.max(.4,this.scale-.1))}faster(){this.scale<1&&this.frameMs<.5*40&&(this.scale=Math.min(1,this.scale+.05)),this.budget=Math.min(6e7,this.budget*1.1)}};var oE=[.5,.2,.9,-.35].flatMap(i=>Array.from({length:12},(t,e)=>{let n=e/12*2*Math.PI,s=Math.sqrt(1-i*i);return[s*Math.cos(n),s*Math.sin(n),i]}));function dx(i,t,e,n,s,r){let o=aE(i,t,n,s,r),a=e,l=ux(i,t,e,n,o);if(l===0)return e;for(let c of oE){let h=1-(c[0]*e[0]+c[1]*e[1]+c[2]*e[2]),u=ux(i,t,c,n,o)+.2*h+(c[2]<0?.3:0);u<l&&([a,l]=[c,u])}return a}function aE(i,t,e,n,s){let r=[];for(let o=0;o*3<e.center.length;o++){let a=0;for(let l=0;l<3;l++){let c=Math.abs(e.center[3*o+l]-i[l])-e.size[3*o+l]/2;a+=Math.max(c,0)**2}a<=t*t&&!n.has(o)&&s(o)&&r.push(o)}return r}function ux(i,t,e,n,s){let r=0;for(let o of s){let a=0,l=t;for(let c=0;c<3&&a<=l;c++){let h=n.size[3*o+c]/2,u=n.center[3*o+c]-i[c];if(Math.abs(e[c])<1e-9){Math.abs(u)>h&&(a=1/0);continue}let[d,f]=[(u-h)/e[c],(u+h)/e[c]];a=Math.max(a,Math.min(d,f)),l=Math.min(l,Math.max(d,f))}a<=l&&(r+=a>0?1:.25)}return r}var lE=160,cE=400,fx=2.2,hE=["selection","hidden","isolated","ghost","marks","question","explode","theme"],th=class{element;navigation;pipeline;plant;store;culling;look;loader;trees;depth=new bc;depthIsOld=!1;pace;listeners=new Set;canvas;frame=0;sample=0;movedAt=-1/0;finished=!1;cameraTimer=0;followed=null;cut=null;constructor(t,e,n,s,r,o,a,l){this.element=t,this.canvas=e,this.store=n,this.pipeline=r,this.plant=new jc(a,l,n.content),this.culling=new yc(this.plant),this.look=new Mc(this.plant,n),this.trees=new Jc(this.plant,this.culling),this.pace=new Qc(o),this.navigation=new Ec(()=>this.moved()),this.loader=new _c(s,a,this.plant,this.culling,r,()=>this.arrived()),this.navigation.setBounds(uE(a)),this.resize(),new ResizeObserver(()=>this.resize()).observe(t),this.repaint(),this.look.recolor(),this.listen();let c=n.shown.camera;c?this.navigation.set(c):this.home(!1)}listen(){let{store:t}=this;t.on("content",()=>this.changed(!0)),t.watch(["colorBy"],()=>this.changed(!0)),t.watch(hE,()=>this.changed(!1)),t.watch(["section"],()=>this.setSection()),t.watch(["hovered"],()=>this.hover()),t.watch(["camera"],()=>this.follow()),new MutationObserver(()=>this.repaint()).observe(document.documentElement,{attributeFilter:["data-theme"]}),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>this.repaint()),t.shown.section&&this.setSection()}async load(){await this.loader.loadCoarse(),this.fill()}get loaded(){return this.loader.share}get camera(){return this.navigation.camera}get stats(){return{frameMs:this.pace.frameMs,triangles:this.culling.triangles,meshes:this.culling.meshes,bytes:this.loader.bytes,loaded:this.loader.share}}get isAtRest(){return this.finished&&this.loader.isComplete}pickHit(t,e){let n=this.pipeline.meshAt(t/this.element.clientWidth,e/this.element.clientHeight);return n<0?null:this.trees.hit(n,this.rayAt(t,e),this.cut)}pick(t,e){let n=this.pickHit(t,e);return n&&{mesh:n.mesh,part:this.plant.partOf[n.mesh],point:n.point.toArray(),normal:n.normal.toArray()}}partAt(t,e){let n=this.pipeline.meshAt(t/this.element.clientWidth,e/this.element.clientHeight);return n<0?-1:this.plant.partOf[n]}rayAt(t,e){let n=new Et(t/this.element.clientWidth*2-1,1-e/this.element.clientHeight*2),s=new jr;return s.setFromCamera(n,this.camera),s.ray}project(t){let e=gE.set(t[0],t[1],t[2],1).applyMatrix4(xE.multiplyMatrices(this.camera.projectionMatrix,this.camera.matrixWorldInverse));return e.w<=0?null:{x:(e.x/e.w/2+.5)*this.element.clientWidth,y:(.5-e.y/e.w/2)*this.element.clientHeight,depth:e.z/e.w}}isHidden(t){return this.depth.isBefore(t[0],t[1],t[2])}get depthTurn(){return this.depth.turn}cornersOf(t){let{center:e,size:n}=this.store.content.parts,s=new Float32Array(24*t.length);return t.forEach((r,o)=>{for(let a=0;a<8;a++)for(let l=0;l<3;l++){let c=a>>l&1?.5:-.5;s[24*o+3*a+l]=e[3*r+l]+c*n[3*r+l]}}),s}flyTo(t){if(!t.length)return;let e=this.cornersOf(t),n=this.camera.getWorldDirection(new P).negate(),{center:s,size:r}=this.store.content.parts,o=h=>this.plant.meshesOfPart.of(h).some(u=>this.look.visible[u]===1),{target:a,distance:l}=this.navigation.fit(e,n,fx),c=dx(a.toArray(),l,n.toArray(),{center:s,size:r},new Set(t),o);this.navigation.flyTo(e,new P(...c),!this.pace.slow,fx)}home(t=!0){let e=this.allCorners(),n=[0,1].map(r=>pE(e,r)),s=n[0]>=n[1]?dE:fE;this.navigation.flyTo(e,s,t&&!this.pace.slow)}lookAlong(t){this.navigation.flyTo(this.allCorners(),t,!this.pace.slow)}allCorners(){let{ground:t}=this.store.content.parts,{hidden:e,isolated:n}=this.store.shown,s=t.map((o,a)=>a).filter(o=>!e.has(o)&&(n?.has(o)??!0)),r=s.filter(o=>!t[o]);return this.cornersOf(r.length?r:s.length?s:[...t.keys()])}getCamera(){return this.navigation.get()}setCamera(t){this.navigation.set(t)}add(t,e=!1){this.pipeline.add(t,e),this.invalidate()}remove(t){t.removeFromParent(),this.invalidate()}invalidate(){this.frame||(this.frame=requestAnimationFrame(t=>this.draw(t)))}onFrame(t){return this.listeners.add(t),()=>this.listeners.delete(t)}picture(){return this.pipeline.show(this.camera),new Promise((t,e)=>{this.canvas.toBlob(n=>n?t(n):e(new Error("no picture")),"image/png")})}redraw(){this.sample=0,this.finished=!1,this.invalidate()}moved(){this.movedAt=performance.now(),this.redraw(),window.clearTimeout(this.cameraTimer),this.cameraTimer=window.setTimeout(()=>{this.followed=this.navigation.get(),this.store.set({camera:this.followed}),this.fill()},250)}follow(){let{camera:t}=this.store.shown;t&&t!==this.followed&&this.navigation.set(t)}fill(){this.loader.fill(this.navigation.get().eye).catch(()=>this.redraw())}arrived(){this.changed(!1)}changed(t){t?this.look.recolor():this.look.update(),this.paint(),this.redraw()}paint(){let{state:t}=this.look;for(let e=0;e<this.plant.n;e++){let n=4*e;this.culling.eachForm(e,(s,r)=>{s.setState(r,t[n],t[n+1],t[n+2],t[n+3])})}this.maskSelected()}maskSelected(){let{mask:t,maskMaterial:e}=this.pipeline;for(let n of[...t.children])t.remove(n),n.geometry.dispose();for(let n of this.look.emphasised.slice(0,cE)){let s=this.culling.formOf(n);if(!s)continue;let r=s.batch.rangeAt(s.instance),o=s.batch.object.geometry,a=new Le;a.setAttribute("position",o.getAttribute("position")),a.setIndex(o.getIndex()),a.setDrawRange(r.indexStart,r.indexCount);let l=new Ie(a,e);l.frustumCulled=l.matrixAutoUpdate=l.matrixWorldAutoUpdate=!1,s.batch.matrixAt(s.instance,this.plant,l.matrixWorld),t.add(l)}}setOffsets(t){let{plant:e}=this;for(let n=0;n<e.n;n++){let s=t.get(e.partOf[n]),r=3*n;!s&&!e.offset[r]&&!e.offset[r+1]&&!e.offset[r+2]||((s??mE).toArray(e.offset,r),this.culling.eachForm(n,(o,a)=>o.setMatrix(a,e)))}this.changed(!1)}hover(){let{hovered:t}=this.store.shown;this.pipeline.setHovered(t>=0?this.plant.meshesOfPart.of(t):[]),this.invalidate()}setSection(){let{section:t}=this.store.shown;if(t){let e="xyz".indexOf(t.axis),n=t.flipped?-1:1;this.cut=new Wt(0,0,0,n*t.at).setComponent(e,n)}else this.cut=null;this.pipeline.setSection(this.cut),this.redraw()}repaint(){let t=getComputedStyle(document.documentElement),e=(r,o)=>t.getPropertyValue(r).trim()||o,n=document.documentElement.dataset.theme==="dark",s={top:e("--sky-top","#e9eef4"),bottom:e("--sky-bottom","#ffffff"),ink:n?"#05080b":"#10161d",accent:"#ffc400",mark:e("--mark","#d1580a")};this.pipeline.setPalette(s),this.redraw()}resize(){let t=Math.max(1,this.element.clientWidth),e=Math.max(1,this.element.clientHeight),n=Math.min(window.devicePixelRatio||1,this.pace.slow?1:2);this.pipeline.setSize(Math.round(t*n),Math.round(e*n),t,e),this.navigation.setAspect(t/e)}draw(t){this.frame=0;let e=performance.now()-this.movedAt<lE;this.finished||this.drawPlant(e),this.pipeline.show(this.camera);for(let n of this.listeners)n();(!this.finished||e)&&(this.pace.frame(t,e),this.invalidate())}drawPlant(t){let{pace:e,culling:n,look:s}=this,r=this.element.clientHeight;if(t){n.look(this.camera,r,s.visible,e.leastPixels,e.budget),this.pipeline.draw(this.camera,{scale:e.scale,sample:0,occlusion:!1,ghosts:s.hasGhosts}),this.sample=0;return}this.sample===0&&n.look(this.camera,r,s.visible,.7,1/0),this.pipeline.draw(this.camera,{scale:1,sample:this.sample,occlusion:!0,ghosts:s.hasGhosts}),this.sample===0&&(this.depthIsOld=!0),this.depthIsOld&&(this.depthIsOld=!this.depth.copy(this.pipeline,this.camera,()=>this.invalidate())),this.sample++,this.finished=this.sample>=e.samples&&!this.depthIsOld}dispose(){this.loader.dispose(),this.pipeline.dispose()}};function uE(i){let{low:t,high:e}=i;return{center:t.map((s,r)=>(s+e[r])/2),radius:Math.max(Math.hypot(e[0]-t[0],e[1]-t[1],e[2]-t[2])/2,.001)}}var dE=new P(-.5,-.8,.5).normalize(),fE=new P(.8,-.5,.5).normalize();function pE(i,t){let e=1/0,n=-1/0;for(let s=t;s<i.length;s+=3)[e,n]=[Math.min(e,i[s]),Math.max(n,i[s])];return n-e}var mE=new P,gE=new Wt,xE=new Mt;var Vd=76,px=28,vE=new P(0,-.0075,0);function mx(i){let t=Vd/2,e=se("svg",{viewBox:`0 0 ${Vd} ${Vd}`,"aria-hidden":"true"}),n=["+X","-X","+Y","-Y","+Z","-Z"].map(c=>{let h=c[0]==="+",u=c[1].toLowerCase(),d=new P().setComponent("XYZ".indexOf(c[1]),h?1:-1),f=`Look from ${c}${{"+Z":" (top)","-Z":" (below)"}[c]??""}`,p=y("button",{type:"button",class:`scene-axis is-${u}${h?"":" is-back"}`,title:f,"aria-label":f,"data-test":`axis${c}`,onclick:()=>i.lookAlong(d.clone().add(vE))},h?c[1]:null),b=h?se("line",{class:`scene-axis-line is-${u}`,x1:t,y1:t}):null;return b&&e.append(b),{name:c,way:d,button:p,line:b}}),s=y("button",{type:"button",class:"scene-axis is-home",title:"The whole plant (0)","aria-label":"The whole plant","data-test":"axis-home",onclick:()=>i.home()}),r=y("div",{class:"scene-axes",role:"group","aria-label":"Directions","data-test":"axes"},e,s,...n.map(({button:c})=>c)),o=new P,a="",l=()=>{let c=i.camera.matrixWorldInverse,h=c.elements.slice(0,11).map(u=>u.toFixed(3)).join();if(h!==a){a=h;for(let{way:u,button:d,line:f}of n){o.copy(u).transformDirection(c);let[p,b]=[o.x*px,-o.y*px];d.style.transform=`translate(${p.toFixed(1)}px, ${b.toFixed(1)}px)`,d.style.zIndex=String(Math.round(4+3*o.z)),d.classList.toggle("is-far",o.z<-.2),f?.setAttribute("x2",(t+p).toFixed(1)),f?.setAttribute("y2",(t+b).toFixed(1))}}};return i.onFrame(l),l(),r}var yE={home:"M4 11.5 12 5l8 6.5M6.5 10v9h11v-9M10.5 19v-5h3v5",fly:"M4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4|M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",hide:"M4 4l16 16M9.5 6.2A10 10 0 0 1 12 6c4.5 0 7.6 3 9 6a12 12 0 0 1-2.6 3.6M6 8a12 12 0 0 0-3 4c1.4 3 4.5 6 9 6a9.6 9.6 0 0 0 3.6-.7M10 10a2.9 2.9 0 0 0 4 4",isolate:"M12 3l8 4.5v9L12 21l-8-4.5v-9z|M12 8.5l3.5 2v4L12 16.5l-3.5-2v-4z",all:"M3 12c1.4-3 4.5-6 9-6s7.6 3 9 6c-1.4 3-4.5 6-9 6s-7.6-3-9-6z|M12 9.2a2.8 2.8 0 1 0 0 5.6 2.8 2.8 0 0 0 0-5.6z",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.4-2-2.3 2-2.3-2-2.3 2-2.3-2z|M9.5 9.8a1.2 1.2 0 1 0 0 2.4 1.2 1.2 0 0 0 0-2.4zM14.5 9.8a1.2 1.2 0 1 0 0 2.4 1.2 1.2 0 0 0 0-2.4z",section:"M4 8l8-4 8 4v8l-8 4-8-4zM12 4v16|M12 4l8 4v8l-8 4z",explode:"M12 9.5V3M9.5 5 12 2.6 14.5 5M12 14.5V21M9.5 19l2.5 2.4L14.5 19M9.5 12H3M5 9.5 2.6 12 5 14.5M14.5 12H21M19 9.5l2.4 2.5-2.4 2.5",measure:"M3 15.5 15.5 3 21 8.5 8.5 21zM6.5 12l2 2M9.5 9l3 3M12.5 6l2 2",parallel:"M4 8h11v12H4zM9 4h11v12M4 8l5-4M15 8l5-4M15 20l5-4",picture:"M4 7.5h4L9.5 5h5L16 7.5h4v11.5H4zM12 9.8a3.4 3.4 0 1 0 0 6.8 3.4 3.4 0 0 0 0-6.8z",close:"M6 6l12 12M18 6 6 18",flip:"M12 4v16M8 8l-4 4 4 4M16 8l4 4-4 4",down:"M6 9.5l6 6 6-6"};function Hd(i){let[t,e]=yE[i].split("|");return se("svg",{viewBox:"0 0 24 24",class:"scene-icon","aria-hidden":"true"},se("path",{d:t}),...e?[se("path",{d:e,class:"is-filled"})]:[])}function xi(i,t,e,n){return y("button",{type:"button",class:"scene-button",title:t,"aria-label":t,"data-test":e,onclick:n},Hd(i))}function Er(i,t){let e=!1,n=()=>{e&&t.element.querySelector("canvas")?.focus({preventScroll:!0}),e=!1};i.addEventListener("pointerdown",()=>e=!0),i.addEventListener("keydown",()=>e=!1),i.addEventListener("change",n)}var gx=.25,xx=.12,Gd=.06,bE=.75,wE=3,_E=40,SE=/\b(bolt|stud|screw|nut|washer|u-bolt)s?\b/i;function vx(i,t){let e=ME(i,t),n=EE(e),s=new Map;if(e.length<2||!(n>0))return s;let r=CE(t),o=TE(e,r,n);for(let{at:c}of e)c.sub(o);let a=new Map,l=[];for(let c of e){if(c.at.length()<Gd*n&&!c.axis){l.push(c);continue}let h=PE(c,r,n);if(h){let u=h.toArray().map(f=>f.toFixed(3)).join(),d=a.get(u);d?d.pieces.push(c):a.set(u,{way:h,pieces:[c]})}else{let u=c.at.length();s.set(c.row,c.at.clone().setLength(Math.max(u,bE*n)))}}for(let{way:c,pieces:h}of a.values())RE(h,c,l,n,s);return s}function yx(i,t){let e=new Map;if(t>0)for(let[n,s]of i)e.set(n,s.clone().multiplyScalar(Math.min(1,t)));return e}function ME(i,t){let{parts:e}=i,n=t.parts.map(a=>({row:a,at:new P().fromArray(e.center,3*a),half:new P().fromArray(e.size,3*a).multiplyScalar(.5),shape:e.shape[a],axis:AE(i,a)})),s=new P(1/0,1/0,1/0),r=new P(-1/0,-1/0,-1/0);for(let{at:a,half:l}of n)s.min(a.clone().sub(l)),r.max(a.clone().add(l));let o=s.add(r).multiplyScalar(.5);for(let{at:a}of n)a.sub(o);return n}function TE(i,t,e){let n=i.filter(a=>!a.axis),s=({half:a})=>a.x*a.y*a.z,r=new P,o=0;for(let{at:a}of[...n].sort((l,c)=>s(c)-s(l)||l.row-c.row).slice(0,_E)){let l=n.filter(c=>{let h=c.at.clone().sub(a);return t.some(u=>h.clone().addScaledVector(u,-h.dot(u)).length()<xx*e)});l.length<=o||(o=l.length,r=a.clone())}return r}function EE(i){let t=new P;for(let{at:e,half:n}of i)t.max(new P(Math.abs(e.x),Math.abs(e.y),Math.abs(e.z)).add(n));return t.length()}function AE(i,t){let{name:e,size:n,extents:s}=i.parts;if(!SE.test(e[t]??""))return null;let r=[0,1,2].map(u=>n[3*t+u]),[o,a,l]=[0,1,2].map(u=>s[3*t+u]),c=o>1.4*a?o:l<.8*a?l:null;if(c===null)return null;let h=r.findIndex(u=>Math.abs(u-c)<.05*c);return h<0?null:new P().setComponent(h,1)}function CE(i){let t=i.ports.find(r=>r.direction)?.direction,e=[new P(1,0,0),new P(0,1,0),new P(0,0,1)];if(!t)return e;let n=new P(...t).normalize();if(!(n.lengthSq()>.5)||e.some(r=>Math.abs(r.dot(n))>.985))return e;let s=new P(0,0,1).addScaledVector(n,-n.z).normalize();return[n,new P().crossVectors(s,n),s]}function PE(i,t,e){if(i.axis){let r=i.at.dot(i.axis);return Math.abs(r)>Gd*e?i.axis.clone().multiplyScalar(Math.sign(r)):null}let n=null,s=xx*e;for(let r of t){let o=i.at.dot(r),a=i.at.clone().addScaledVector(r,-o).length();a<s&&Math.abs(o)>Gd*e&&(s=a,n=r.clone().multiplyScalar(Math.sign(o)))}return n}function RE(i,t,e,n,s){let r=Math.max(0,...e.map(a=>bx(a,t))),o=gx*n;for(let a of LE(i,t,n)){let l=Math.min(wE*n,Math.max(o,r+gx*n-a.near));for(let c of a.pieces)s.set(c.row,t.clone().multiplyScalar(l));r=Math.max(r,a.far+l),o=l}}function LE(i,t,e){let n=[];for(let s of[...i].sort((r,o)=>r.at.dot(t)-o.at.dot(t)||r.row-o.row)){let r=s.at.dot(t),o=bx(s,t),a=n.find(l=>l.pieces[0].shape===s.shape&&Math.abs(l.pieces[0].at.dot(t)-r)<.04*e);a?(a.pieces.push(s),a.near=Math.min(a.near,r-o),a.far=Math.max(a.far,r+o)):n.push({near:r-o,far:r+o,pieces:[s]})}return n}function bx({half:i},t){return Math.abs(i.x*t.x)+Math.abs(i.y*t.y)+Math.abs(i.z*t.z)}var wx=new Map;function _x(i,t){let e=y("span",{class:"scene-card-title"}),n=y("input",{type:"range",min:0,max:100,step:1,"aria-label":"How far its parts are drawn apart","data-test":"explode-share",oninput:()=>t.shown.explode&&t.set({explode:{...t.shown.explode,share:Number(n.value)/100}})}),s=xi("close","Together again (e)","explode-close",()=>t.set({explode:null})),r=y("div",{class:"scene-card",role:"group","aria-label":"Unit drawn apart","data-test":"explode-panel"},e,n,s);Er(n,i);let o=wx,a="",l=!1,c=0,h=()=>{c=0;let{explode:d}=t.shown;(d||l)&&i.setOffsets(d?yx(o,d.share):wx),l=!!d},u=()=>{let{explode:d}=t.shown,f=d&&t.content?.network.units.find(p=>p.id===d.unit);if(d&&!f){t.set({explode:null});return}r.hidden=!d,!d||!f?a="":a!==f.id&&(a=f.id,o=vx(t.content,f)),e.textContent=f?`${f.tag} apart`:"",d&&(n.value=String(Math.round(100*d.share))),c||(c=requestAnimationFrame(h))};return t.watch(["explode"],u),t.on("content",()=>{a="",u()}),u(),r}var IE=[["group","Group"],["name","Label"],["unit","Unit"],["system","System"],["cluster","Structure"],["confidence","How sure"],["source","Who said the label"],["original","Colours of the file"]],Wd=200,kE=480;function Mx(i,t){let e=y("select",{"aria-label":"Colour by",title:"Colour by","data-test":"color-by",onchange:()=>t.set({colorBy:e.value})},...IE.map(([h,u])=>y("option",{value:h},u)));Er(e,i);let n=y("button",{type:"button",class:"scene-button scene-fold","aria-controls":"scene-legend-rows","data-test":"legend-fold",onclick:()=>o(!!s.hidden)},Hd("down")),s=y("ul",{class:"scene-legend-rows",id:"scene-legend-rows","data-test":"legend"}),r=y("section",{class:"scene-legend","aria-label":"Colours"},y("div",{class:"scene-legend-head"},e,n),s),o=h=>{s.hidden=!h,n.setAttribute("aria-expanded",String(h)),n.title=h?"Fold the legend":"Show what the colours mean",n.setAttribute("aria-label",n.title)},a=[],l=()=>{let{isolated:h}=t.shown;for(let{parts:u,button:d}of a)d.setAttribute("aria-pressed",String(!!h&&u.length>0&&u.every(f=>h.has(f))))},c=()=>{e.value=t.shown.colorBy,a=NE(s,t),l()};return t.watch(["colorBy"],c),t.watch(["isolated"],l),t.on("content",c),c(),o(i.element.clientWidth>=kE),r}function NE(i,t){i.replaceChildren();let{entries:e,hatched:n}=Sc(t.content,t.shown.colorBy),s=e.slice(0,Wd).map(a=>Sx(a,t)),r=new Set(e.flatMap(a=>a.hatched?a.parts:[])),o=[...n.keys()].filter(a=>n[a]&&!r.has(a));return o.length&&s.push(Sx({label:"Not sure",color:"",hatched:!0,parts:o},t)),i.append(...s.map(({button:a})=>y("li",{},a))),e.length>Wd&&i.append(y("li",{class:"scene-soft"},`and ${e.length-Wd} more with fewer parts`)),e.length||i.append(y("li",{class:"scene-soft"},"Each mesh has the colour that the file gives it.")),s}function Sx(i,t){let e=y("span",{class:i.hatched?"scene-swatch is-hatched":"scene-swatch"});i.color&&(e.style.backgroundColor=i.color);let{parts:n}=i,s=y("button",{type:"button",class:"scene-legend-row","data-test":"legend-row",disabled:!n.length,title:`${i.label}: show only ${n.length===1?"this part":`these ${n.length} parts`}; with Ctrl these, too`,onclick:r=>DE(t,n,r.ctrlKey||r.metaKey)},e,y("span",{class:"scene-legend-label"},i.label),y("span",{class:"scene-soft"},String(n.length)));return{parts:n,button:s}}function DE(i,t,e){let{isolated:n}=i.shown,s=!!n&&t.every(o=>n.has(o));if(!e){i.set({isolated:s&&n.size===t.length?null:new Set(t)});return}let r=new Set(n??[]);for(let o of t)s?r.delete(o):r.add(o);i.set({isolated:r.size?r:null})}var OE=10,FE=8,UE=Math.cos(.5*Math.PI/180);function Ax(i,t,e){let{corners:n,normal:s}=i,r=c=>{let h=e(c);return h?Math.hypot(h.x-t.x,h.y-t.y):1/0},o=Tx(n,r);if(o&&r(o)<=OE)return{point:o.clone(),normal:s,kind:"corner"};let a=n.map((c,h)=>new Qe(c,n[(h+1)%n.length]).closestPointToPoint(i.point,!0,new P)),l=Tx(a,r);return l&&r(l)<=FE?{point:l,normal:s,kind:"edge"}:{point:i.point.clone(),normal:s,kind:"face"}}function Tx(i,t){let e=null;for(let n of i)(!e||t(n)<t(e))&&(e=n);return e}function Xd(i,t){let e=new P().subVectors(t.point,i.point),n=Math.abs(i.normal.dot(t.normal))>UE;return{distance:e.length(),along:[Math.abs(e.x),Math.abs(e.y),Math.abs(e.z)],between:n?Math.abs(e.dot(i.normal)):null}}function $d(i){return i<.9995?`${BE((1e3*i).toFixed(i<.1?1:0))} mm`:`${i.toFixed(i<100?3:2)} m`}function BE(i){return i.replace(/\.0$/,"")}function qd({distance:i,along:t,between:e}){return[$d(i),["x","y","z"].map((n,s)=>`d${n} ${$d(t[s])}`).join("   "),e===null||e<5e-5?null:`parallel faces ${$d(e)} apart`]}function Cx(i,t,e){let n=Math.hypot(t.x-i.x,t.y-i.y),s=t.x<i.x?-1:1,r=n<1?{x:0,y:-1}:{x:s*(t.y-i.y)/n,y:-s*(t.x-i.x)/n},o=(Math.abs(r.x)*e.width+Math.abs(r.y)*e.height)/2+8;return{x:(i.x+t.x)/2+r.x*o,y:(i.y+t.y)/2+r.y*o}}var Ex=4,zE=12;function Px(i,t,e){let n=o=>({x:i.x,y:o,...t}),s=o=>e.filter(a=>Math.abs(o.x-a.x)<(o.width+a.width)/2&&Math.abs(o.y-a.y)<(o.height+a.height)/2+Ex-1),r=null;for(let o of[-1,1]){let a=n(i.y),l=s(a);for(let c=0;c<zE&&l.length;c++){let h=l.map(u=>o*u.y+u.height/2);a=n(o*(Math.max(...h)+t.height/2+Ex)),l=s(a)}!l.length&&(!r||Math.abs(a.y-i.y)<Math.abs(r.y-i.y))&&(r=a)}return r??n(i.y)}var VE=40,Rx=1e-7,eh=class{overlay;panel;view;store;lines=se("svg",{class:"scene-measure-lines","aria-hidden":"true"});cursor=se("g",{class:"scene-catch"});hint=y("span",{role:"status","data-test":"measure-hint"});clear;kept=[];preview=null;first=null;caught=null;timer=0;said="";constructor(t,e){this.view=t,this.store=e,this.lines.append(this.cursor),this.overlay=y("div",{class:"scene-measure","data-test":"measurements"},this.lines),this.clear=y("button",{type:"button","data-test":"measure-clear",onclick:()=>this.removeAll()},"Remove all"),this.panel=y("div",{class:"scene-card",role:"group","aria-label":"Measure","data-test":"measure-panel"},y("span",{class:"scene-card-title"},"Measure"),this.hint,this.clear,xi("close","End measuring (Esc)","measure-close",()=>e.set({tool:"select"}))),t.onFrame(()=>this.place()),t.element.querySelector("canvas").addEventListener("pointerleave",()=>this.look(null)),e.watch(["tool"],()=>this.update()),this.update()}get isOn(){return this.store.shown.tool==="measure"}isBusy(){return this.isOn||this.kept.length>0}escape(){if(this.first)this.drop();else if(this.isOn)this.store.set({tool:"select"});else if(this.kept.length)this.removeAll();else return!1;return!0}hovered(t,e){return this.isOn?(window.clearTimeout(this.timer),this.timer=window.setTimeout(()=>this.look(this.catchAt(t,e)),VE),!0):!1}clicked(t,e){if(!this.isOn)return!1;let n=this.catchAt(t,e);return n&&!this.first?(this.first=n,this.said=""):n&&n.point.distanceTo(this.first.point)>Rx&&this.keep(n),this.look(n),this.update(),!0}catchAt(t,e){let n=this.view.pickHit(t,e);return n&&Ax(n,{x:t,y:e},s=>this.view.project(s.toArray()))}keep(t){let e=this.first,[n,s,r]=qd(Xd(e,t)),o=this.draw(e.point,t.point,n,s,r);o.label.classList.add("is-kept"),o.label.append(xi("close",`Remove this measurement: ${n}`,"measure-remove",()=>this.remove(o))),o.size.width=o.label.offsetWidth,this.kept.push(o),this.said=`${n}${r?`, ${r}`:""}. Click the next first point.`,this.drop()}look(t){if(window.clearTimeout(this.timer),this.caught=this.isOn?t:null,this.cursor.replaceChildren(...this.caught?[HE(this.caught.kind)]:[]),this.erase(this.preview),this.preview=null,this.first&&this.caught&&this.first.point.distanceTo(this.caught.point)>Rx){let[e,n,s]=qd(Xd(this.first,this.caught));this.preview=this.draw(this.first.point,this.caught.point,e,n,s)}this.place()}draw(t,e,n,s,r){let o=se("g");for(let l of["leg is-x","leg is-y","leg is-z","casing","line"])o.append(se("line",{class:`scene-measure-${l}`}));for(let l=0;l<2;l++)o.append(se("circle",{r:3.5,class:"scene-measure-end"}));this.lines.insertBefore(o,this.cursor);let a=y("div",{class:"scene-measure-label","data-test":"measurement"},y("div",{},y("strong",{},n),y("div",{class:"scene-measure-along"},s),r&&y("div",{},r)));return this.overlay.append(a),{from:t,to:e,group:o,label:a,size:{width:a.offsetWidth,height:a.offsetHeight}}}erase(t){t?.group.remove(),t?.label.remove()}remove(t){this.erase(t),this.kept.splice(this.kept.indexOf(t),1),this.update()}removeAll(){for(let t of this.kept)this.erase(t);this.kept.length=0,this.drop(),this.update()}drop(){this.first=null,this.look(this.caught),this.update()}update(){this.isOn||(this.first=null,this.said="",(this.caught||this.preview)&&this.look(null)),this.view.element.classList.toggle("is-measuring",this.isOn),this.panel.hidden=!this.isOn,this.clear.hidden=!this.kept.length,this.hint.textContent=this.first?"Click the second point.":this.said||"Click the first point: corners and edges catch.",this.place()}place(){if(!this.caught&&!this.kept.length&&!this.preview&&!this.first)return;let t=this.first&&!this.caught?this.first:this.caught,e=t&&this.view.project(t.point.toArray());this.cursor.toggleAttribute("hidden",!e),e&&this.cursor.setAttribute("transform",`translate(${e.x} ${e.y})`);let n=[];for(let s of this.preview?[...this.kept,this.preview]:this.kept)this.placeOne(s,n)}placeOne({from:t,to:e,group:n,label:s,size:r},o){let a=new P(e.x,t.y,t.z),l=new P(e.x,e.y,t.z),[c,h,u,d]=[t,e,a,l].map(m=>this.view.project(m.toArray())),f=!!c&&!!h&&!!u&&!!d;if(n.toggleAttribute("hidden",!f),s.hidden=!f,!f)return;let p=[[c,u],[u,d],[d,h],[c,h],[c,h]];[...n.querySelectorAll("line")].forEach((m,g)=>{let[w,S]=p[g];for(let[x,_]of[["x1",w.x],["y1",w.y],["x2",S.x],["y2",S.y]])m.setAttribute(x,_.toFixed(1))}),[...n.querySelectorAll("circle")].forEach((m,g)=>{m.setAttribute("cx",[c,h][g].x.toFixed(1)),m.setAttribute("cy",[c,h][g].y.toFixed(1))});let b=Px(Cx(c,h,r),r,o);o.push(b),s.style.transform=`translate(${(b.x-r.width/2).toFixed(1)}px, ${(b.y-r.height/2).toFixed(1)}px)`}};function HE(i){return i==="corner"?se("rect",{x:-5,y:-5,width:10,height:10}):i==="edge"?se("path",{d:"M0 -6.5 6 4.5H-6z"}):se("circle",{r:5})}var Yd=1e3,nh=["x","y","z"];function Zd(i,t){let{center:e,size:n,id:s}=i.parts,r=[1/0,1/0,1/0],o=[-1/0,-1/0,-1/0];for(let a of t??s.keys())for(let l=0;l<3;l++)r[l]=Math.min(r[l],e[3*a+l]-n[3*a+l]/2),o[l]=Math.max(o[l],e[3*a+l]+n[3*a+l]/2);return r[0]<=o[0]?{low:r,high:o}:null}function Jd(i,t,e,n){let s=(e.length?Zd(t,e):null)??Zd(t);if(!s)return null;let r=nh.indexOf(i),o=(s.low[r]+s.high[r])/2;return{axis:i,at:o,flipped:n[r]<o}}function Ix(i,t){let e=u=>t.shown.section&&t.set({section:{...t.shown.section,...u}}),n=nh.map(u=>y("button",{type:"button",title:`Cut across ${u.toUpperCase()}`,"data-test":`section-${u}`,onclick:()=>t.set({section:Jd(u,t.content,t.shown.selection,i.getCamera().eye)})},u.toUpperCase())),s=y("input",{type:"range",min:0,max:Yd,step:1,"aria-label":"Where the plant is cut","data-test":"section-at"}),r=y("output",{class:"scene-value","data-test":"section-value"}),o=xi("flip","Show the other side","section-flip",()=>e({flipped:!t.shown.section?.flipped})),a=xi("close","No section (x)","section-close",()=>t.set({section:null})),l=y("div",{class:"scene-card",role:"group","aria-label":"Section","data-test":"section-panel"},y("span",{class:"scene-card-title"},"Section"),y("div",{class:"scene-axes-choice"},...n),s,r,o,a);Er(s,i);let c=0;s.addEventListener("input",()=>{c||(c=requestAnimationFrame(()=>{c=0;let u=Lx(t);u&&e({at:u.low+(u.high-u.low)*(Number(s.value)/Yd)})}))});let h=()=>{let{section:u}=t.shown;l.hidden=!u;let d=Lx(t);!u||!d||(n.forEach((f,p)=>f.setAttribute("aria-pressed",String(nh[p]===u.axis))),o.setAttribute("aria-pressed",String(u.flipped)),s.value=String(Math.round(Yd*(u.at-d.low)/Math.max(d.high-d.low,1e-9))),r.textContent=`${(u.at+d.origin).toFixed(3)} m`,s.setAttribute("aria-valuetext",`${u.axis} = ${r.textContent}`))};return t.watch(["section"],h),t.on("content",h),h(),l}function Lx(i){let{content:t,shown:e}=i,n=t&&e.section&&Zd(t);if(!n)return null;let s=nh.indexOf(e.section.axis);return{low:n.low[s],high:n.high[s],origin:t.origin[s]}}var kx=10*Math.PI/180,Nx=.8;function Fx(i,t,e){let n=()=>Ar(t).length>0;ii({id:"view-home",key:"0",title:"The whole plant",area:"View",run:()=>i.home()},{id:"view-fly",key:"f",title:"Fly to the selection",area:"View",when:n,run:()=>i.flyTo(Ar(t))},{id:"view-hide",key:"h",title:"Hide the selection",area:"Selection",when:n,run:()=>WE(t)},{id:"view-isolate",key:"i",title:"Show only the selection",area:"Selection",when:()=>n()||!!t.shown.isolated,run:()=>$E(t)},{id:"view-all",key:"a",title:"Show all again",area:"Selection",run:()=>XE(t)},{id:"view-ghost",key:"g",title:"Draw faintly what is not shown, or leave it out",area:"View",run:()=>t.set({ghost:!t.shown.ghost})},{id:"view-section",key:"x",title:"Cut the plant open",area:"View",run:()=>qE(i,t)},{id:"view-explode",key:"e",title:"Draw the selected unit apart",area:"Selection",when:()=>!!t.shown.explode||Ux(t)!==null,run:()=>YE(i,t)},{id:"view-measure",key:"m",title:"Measure between two points",area:"View",run:()=>t.set({tool:t.shown.tool==="measure"?"select":"measure",hovered:-1})},{id:"view-parallel",key:"p",title:"Without perspective",area:"View",run:()=>i.navigation.setOrthographic(!i.navigation.orthographic)},{id:"view-picture",title:"Save the picture",area:"View",run:()=>{ZE(i,t)}},{id:"view-nearer",key:"+",title:"Nearer",area:"View",run:()=>Dx(i,Nx)},{id:"view-farther",key:"-",title:"Farther",area:"View",run:()=>Dx(i,1/Nx)},...GE(i),{id:"view-escape",key:"Escape",title:"End the tool, then drop the selection",area:"Selection",when:()=>e.isBusy()||!!Ox(t),run:()=>e.escape()||t.set(Ox(t)??{})})}function GE(i){let t=()=>document.activeElement===document.body||document.activeElement instanceof HTMLCanvasElement,e=(n,s,r,o,a)=>({id:n,key:s,title:r,area:"View",when:t,run:()=>i.navigation.orbit(new P(...i.getCamera().target),o*kx,a*kx)});return[e("view-turn-left","ArrowLeft","Turn left",-1,0),e("view-turn-right","ArrowRight","Turn right",1,0),e("view-turn-up","ArrowUp","Turn up",0,-1),e("view-turn-down","ArrowDown","Turn down",0,1)]}function Ar(i){let{selection:t,question:e}=i.shown;return t.length?t:e?.parts??[]}function Ux(i){let{content:t,shown:e}=i;if(!t)return null;let{units:n}=t.network,s=e.place?n.find(r=>r.id===e.place):n[t.parts.unit[Ar(i)[0]??-1]??-1];return s&&s.parts.length>1?s:null}function WE(i){i.set({hidden:new Set([...i.shown.hidden,...Ar(i)]),selection:[],place:null})}function $E(i){let t=Ar(i),{isolated:e}=i.shown,n=e&&(!t.length||e.size===new Set(t).size&&t.every(s=>e.has(s)));i.set({isolated:n?null:new Set(t)})}function Bx(i){let{hidden:t,isolated:e,marks:n,explode:s}=i.shown;return t.size>0||!!e||!!n||!!s}function XE(i){i.set({hidden:new Set,isolated:null,marks:null,explode:null})}function qE(i,t){let{content:e,shown:n}=t,s=e&&!n.section;t.set({section:s?Jd("y",e,Ar(t),i.getCamera().eye):null})}function YE(i,t){let e=Ux(t);if(t.shown.explode||!e){t.set({explode:null});return}t.set({explode:{unit:e.id,share:.6}}),i.flyTo(e.parts)}function Dx(i,t){i.navigation.zoom(new P(...i.getCamera().target),t)}function Ox(i){let{explode:t,selection:e,place:n,marks:s}=i.shown;return t?{explode:null}:e.length||n?{selection:[],place:null}:s?{marks:null}:null}async function ZE(i,t){let e=URL.createObjectURL(await i.picture()),n=document.createElement("a");n.href=e,n.download=`${(t.content?.title??"plant").replace(/\.[^.]*$/,"").replace(/[^\p{L}\p{N} ._-]+/gu,"_")||"plant"}.png`,n.click(),window.setTimeout(()=>URL.revokeObjectURL(e),1e4)}function zx(i,t){let{navigation:e}=i,n=[[{icon:"home",command:"view-home"},{icon:"fly",command:"view-fly"}],[{icon:"hide",command:"view-hide"},{icon:"isolate",command:"view-isolate",pressed:()=>!!t.shown.isolated},{icon:"all",command:"view-all"},{icon:"ghost",command:"view-ghost",pressed:()=>t.shown.ghost}],[{icon:"section",command:"view-section",pressed:()=>!!t.shown.section},{icon:"explode",command:"view-explode",pressed:()=>!!t.shown.explode},{icon:"measure",command:"view-measure",pressed:()=>t.shown.tool==="measure"}],[{icon:"parallel",command:"view-parallel",pressed:()=>e.orthographic},{icon:"picture",command:"view-picture"}]],s=new Map(Uo().map(u=>[u.id,u])),r=[],o=[],a=u=>{let d=s.get(u.command),f=d.key?`${d.title} (${d.key})`:d.title,p=xi(u.icon,f,u.command,()=>zn(u.command));return d.key&&p.setAttribute("aria-keyshortcuts",d.key),r.push(p),o.push(()=>{p.disabled=!(d.when?.()??!0)||u.command==="view-all"&&!Bx(t),u.pressed&&p.setAttribute("aria-pressed",String(u.pressed()))}),p},l=y("div",{class:"scene-bar",role:"toolbar","aria-label":"View","data-test":"toolbar"},...n.map(u=>y("div",{class:"scene-bar-group"},...u.map(a)))),c=()=>{o.forEach(u=>u()),JE(r)};l.addEventListener("keydown",u=>KE(u,r)),t.on("shown",c),t.on("content",c);let h=e.orthographic;return i.onFrame(()=>{h!==e.orthographic&&(h=e.orthographic,c())}),c(),l}function JE(i){let t=i.find(e=>e.tabIndex===0&&!e.disabled)??i.find(e=>!e.disabled);for(let e of i)e.tabIndex=e===t?0:-1}function KE(i,t){let e={ArrowRight:1,ArrowLeft:-1}[i.key],n=t.filter(o=>!o.disabled),s=n.indexOf(document.activeElement);if(!e||s<0)return;i.preventDefault();let r=n[(s+e+n.length)%n.length];for(let o of t)o.tabIndex=o===r?0:-1;r.focus()}function Vx(i,t){let e=new eh(i,t);Fx(i,t,e);let n=y("div",{class:"scene-cards"},e.panel,_x(i,t),Ix(i,t)),s=y("div",{class:"scene-foot"},n,zx(i,t));return i.element.append(e.overlay,Mx(i,t),mx(i),s),e}var Hx="This browser draws no 3D here: WebGL 2 is switched off or missing. Lists, tables and the drawing work without it.";async function Gx(i,t,e){let n=document.createElement("div");n.className="scene";let s=document.createElement("canvas");s.className="scene-canvas",s.dataset.test="canvas",s.tabIndex=0,s.setAttribute("role","img"),s.setAttribute("aria-label","The plant in 3D. Arrow keys turn it, plus and minus come closer and go away.");let r=document.createElement("div");r.className="scene-note",r.setAttribute("role","status"),r.dataset.test="scene-note",n.append(s,r),i.append(n);let o=jE();if(o===null)throw r.textContent=Hx,new Error(Hx);let a=new xc(s,!o);r.textContent="Reading the plant...";let l=await e.manifest(),c=await e.file(l.instances),h=new th(n,s,t,e,a,o,l,c);QE(s,r,h);let u=Vx(h,t);eA(s,h,t,u);let d=tA(r),f=h.onFrame(()=>d(h.loaded));return h.load().then(()=>{f(),r.textContent=""},p=>r.textContent=`Parts of the plant could not be read: ${p.message}`),h}function jE(){let i=document.createElement("canvas").getContext("webgl2");if(!i)return null;let t=i.getExtension("WEBGL_debug_renderer_info"),e=String(i.getParameter(t?t.UNMASKED_RENDERER_WEBGL:i.RENDERER));return i.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|softpipe|software|basic render/i.test(e)}function QE(i,t,e){i.addEventListener("webglcontextlost",n=>{n.preventDefault(),t.textContent="The graphics card dropped the picture; it comes back by itself, else reload the page."}),i.addEventListener("webglcontextrestored",()=>{t.textContent="",e.redraw()})}function tA(i){let t=document.createElement("progress");return t.max=1,i.replaceChildren("Loading shapes ",t),e=>{t.value=e}}function eA(i,t,e,n){let s=0;new gc(i,t.navigation,{pointAt:(r,o)=>t.pickHit(r,o)?.point??nA(t,r,o),clicked:(r,o,a)=>{i.focus({preventScroll:!0}),n.clicked(r,o)||iA(t,e,r,o,a.ctrlKey||a.metaKey)},doubleClicked:(r,o)=>{if(e.shown.tool!=="select")return;let a=t.partAt(r,o);a>=0&&t.flyTo([a])},hovered:(r,o)=>{n.hovered(r,o)||(window.clearTimeout(s),s=window.setTimeout(()=>e.set({hovered:t.partAt(r,o)}),60))},left:()=>{window.clearTimeout(s),e.set({hovered:-1})}})}function nA(i,t,e){let n=i.rayAt(t,e),{eye:s,target:r}=i.getCamera(),o=new P(...r).sub(new P(...s)),a=n.direction.dot(o.clone().normalize()),l=new P(...r).sub(n.origin).dot(o.normalize())/Math.max(a,.001);return n.at(l,new P)}function iA(i,t,e,n,s){let r=i.partAt(e,n),{selection:o,place:a}=t.shown;if(r<0){s||t.select([]);return}if(s){t.select(o.includes(r)?o.filter(c=>c!==r):[...o,r]);return}let l=t.content.network.units[t.content.parts.unit[r]];l&&o.length===1&&o[0]===r&&a===null?t.selectPlace(l.id):t.select([r])}var sA={selection:[],place:null,hovered:-1,hidden:new Set,isolated:null,ghost:!0,colorBy:"group",marks:null,network:!0,tags:!0,section:null,explode:null,tool:"select",question:null,leftTab:"find",schematic:!1,table:!1,theme:"light",camera:null},ih=class{content=null;state=null;shown=sA;listeners={content:new Set,state:new Set,shown:new Set,gone:new Set};on(t,e){return this.listeners[t].add(e),()=>this.listeners[t].delete(e)}watch(t,e){return this.on("shown",n=>{t.some(s=>n.has(s))&&e()})}set(t){let e=new Set;for(let n of Object.keys(t))t[n]!==this.shown[n]&&e.add(n);e.size&&(this.shown={...this.shown,...t},this.tell("shown",e))}setState(t){this.state=t,this.tell("state",t)}setContent(t){let e=this.content,n=e&&rA(e.meshes,t.meshes);this.content=n?{...t,meshes:e.meshes}:t;let{place:s}=this.shown;e&&!n&&this.keepRows(e);let r=this.keepPlaces(e??this.content);this.tell("content",this.content),r&&s&&this.tell("gone",oA(e??this.content,s))}apply(t){if(this.setState(t.state),t.reload||!this.content)return!1;let e=this.content.parts;for(let n of Object.keys(e)){let s=e[n],r=t.parts[n],o=n==="center"||n==="size"||n==="extents"?3:1;t.rows.forEach((a,l)=>{for(let c=0;c<o;c++)s[a*o+c]=r[l*o+c]})}return this.setContent({...this.content,version:t.version,parts:e,network:t.network,diagnostics:t.diagnostics}),!0}select(t,e=null){this.set({selection:t,place:e})}selectPlace(t){let e=this.content?.network,n=e?.units.find(s=>s.id===t)??e?.ends.find(s=>s.id===t);n&&this.select(n.parts,t)}keepPlaces(t){let e=this.content,{place:n,selection:s,explode:r}=this.shown,o=e.parts.id.length;if(s.some(c=>c>=o)&&this.set({selection:s.filter(c=>c<o)}),r){let c=Es(t,r.unit,e);c?.id!==r.unit&&this.set({explode:c&&{...r,unit:c.id}})}if(!n)return!1;let a=Es(t,n,e);return a?((!(a.parts.length===s.length&&a.parts.every((c,h)=>c===s[h]))||a.id!==n)&&this.set({selection:a.parts,place:a.id}),!1):(this.set({selection:[],place:null}),!0)}keepRows(t){let e=zo(t,this.content),n=a=>[...new Set([...a].map(e))].filter(l=>l>=0),{selection:s,hidden:r,isolated:o}=this.shown;this.set({selection:n(s),hidden:new Set(n(r)),isolated:o&&new Set(n(o)),hovered:-1,marks:null,question:null})}tell(t,e){for(let n of[...this.listeners[t]])n(e)}};function rA(i,t){return i===t||i.path.length===t.path.length&&i.path.every((e,n)=>e===t.path[n]&&i.part[n]===t.part[n])}function oA({network:i},t){return i.units.find(e=>e.id===t)?.tag??i.ends.find(e=>e.id===t)?.name??t}var Kd=df(),sh=new ih;window.cadgraph={store:sh,view:null};var No=n0(document.getElementById("app"),sh,Kd);ff(document);await No.untilReady();try{let i=await Gx(No.middle,sh,Kd);window.cadgraph.view=i,mg(i,sh,Kd,No),No.connect(i)}catch(i){throw No.say(`The plant can't be drawn: ${i.message}`,"bad"),i}
