(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Pairs that no refinement decides [SET-1] [SET-2]: legal for no narrowing, possible for every one. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc TiedFace.
Open Scope R_scope.

(* B' is what rectangles are narrowed to. Along x those of FX have a core, which stays inside of their narrowed
   rectangles; so have those of FY along y. B has the cores there, and elsewhere the rectangles before narrowing. *)
Definition narrowing (N : nat) (FX FY : nat -> Prop) (B B' : sites) : Prop :=
  forall k, (k < N)%nat ->
    (FX k -> xlo (B' k) <= xlo (B k) /\ xhi (B k) <= xhi (B' k)) /\
    (~ FX k -> xlo (B k) <= xlo (B' k) /\ xhi (B' k) <= xhi (B k)) /\
    (FY k -> ylo (B' k) <= ylo (B k) /\ yhi (B k) <= yhi (B' k)) /\
    (~ FY k -> ylo (B k) <= ylo (B' k) /\ yhi (B' k) <= yhi (B k)).

(* Rectangles whose fixed sides stay as they are have these as cores. *)
Lemma narrowing_of_fixed N (FX FY : nat -> Prop) B B' : refined N B' B ->
  (forall k, (k < N)%nat -> FX k -> xlo (B' k) = xlo (B k) /\ xhi (B' k) = xhi (B k)) ->
  (forall k, (k < N)%nat -> FY k -> ylo (B' k) = ylo (B k) /\ yhi (B' k) = yhi (B k)) -> narrowing N FX FY B B'.
Proof.
  intros Re X Y k K. specialize (X k K). specialize (Y k K).
  destruct (Re k K (xlo (B' k), ylo (B' k))) as [A D].
  { pose proof (x_ordered (B' k)). pose proof (y_ordered (B' k)). split; simpl; lra. }
  destruct (Re k K (xhi (B' k), yhi (B' k))) as [E F].
  { pose proof (x_ordered (B' k)). pose proof (y_ordered (B' k)). split; simpl; lra. }
  simpl in *. split; [intros S; specialize (X S); lra |]. split; [intros _; lra |].
  split; [intros S; specialize (Y S); lra | intros _; lra].
Qed.

(* Any place in a core is there afterwards as before; in other sides some place is. *)
Lemma narrowing_point N FX FY B B' k g : (k < N)%nat -> narrowing N FX FY B B' -> inside g (B k) ->
  exists z, inside z (B' k) /\ inside z (B k) /\ (FX k -> fst z = fst g) /\ (FY k -> snd z = snd g).
Proof.
  intros K W [Gx Gy]. destruct (W k K) as [X [X' [Y Y']]]. destruct (nearest_inside (0, 0) (B' k)) as [Nx Ny].
  assert (Sx : exists x, xlo (B' k) <= x <= xhi (B' k) /\ xlo (B k) <= x <= xhi (B k) /\ (FX k -> x = fst g)).
  { destruct (classic (FX k)) as [H | H]; [exists (fst g); specialize (X H) |
      exists (fst (nearest (0, 0) (B' k))); specialize (X' H)]; repeat split; try lra; tauto. }
  assert (Sy : exists y, ylo (B' k) <= y <= yhi (B' k) /\ ylo (B k) <= y <= yhi (B k) /\ (FY k -> y = snd g)).
  { destruct (classic (FY k)) as [H | H]; [exists (snd g); specialize (Y H) |
      exists (snd (nearest (0, 0) (B' k))); specialize (Y' H)]; repeat split; try lra; tauto. }
  destruct Sx as [x [Ix [Jx Ex]]]. destruct Sy as [y [Iy [Jy Ey]]]. exists (x, y). unfold inside. simpl. tauto.
Qed.

Lemma narrowing_core N FX FY B B' k : (k < N)%nat -> narrowing N FX FY B B' -> FX k -> FY k -> refines (B k) (B' k).
Proof.
  intros K W Hx Hy z [Zx Zy]. destruct (W k K) as [X [_ [Y _]]]. specialize (X Hx). specialize (Y Hy). unfold inside. lra.
Qed.

(* The interval within the radius r of every place x that the centre may have: each [lo', hi'] that holds all within r
   of such a place, in [lo, hi], holds the core [SET-3]. *)
Theorem core_stays lo hi lo' hi' x r : lo <= lo' -> hi' <= hi -> lo' <= x - r -> x + r <= hi' ->
  lo' <= hi - 2 * r /\ lo + 2 * r <= hi'.
Proof. lra. Qed.

(* g chooses points along the sides that stay; a part of the sites is numbered anew, m is the site e m, and represents
   all of its rectangle with this choice. *)
Theorem part_refutes_legal N M FX FY B B' C (g : nat -> point) (e : nat -> nat) a b :
  narrowing N FX FY B B' -> (forall k, (k < N)%nat -> inside (g k) (B k)) ->
  (forall m, (m < M)%nat -> (e m < N)%nat /\ forall x, inside x (B (e m)) -> (FX (e m) -> fst x = fst (g (e m))) ->
    (FY (e m) -> snd x = snd (g (e m))) -> inside x (C m)) ->
  (a < M)%nat -> (b < M)%nat -> ~ possible M C a b -> ~ legal N B' (e a) (e b).
Proof.
  intros W G E A D Np L. apply Np. clear Np.
  destruct (finite_choice (0, 0) (fun k z => inside z (B' k) /\ inside z (B k) /\ (FX k -> fst z = fst (g k)) /\
    (FY k -> snd z = snd (g k))) N) as [p P].
  { intros k K. apply (narrowing_point N FX FY B B' k (g k) K W), G, K. }
  destruct (E a A) as [Ea _]. destruct (E b D) as [Eb _].
  destruct (legal_sound N B' (e a) (e b) p Ea Eb L) as [c [Eq Out]]; [intros k K; now apply P |].
  left. apply (pair_possible M C a b A D). exists c.
  apply (disc_shows_possible M C (pair a b) (fun m => p (e m)) c (dist c (p (e a)))).
  - intros m H. destruct (E m H) as [K X]. destruct (P (e m) K) as [_ [I [Zx Zy]]]. now apply X.
  - split; [now intros i _ [-> | ->] |]. intros m H. destruct (E m H) as [K _].
    destruct (Nat.eq_dec (e m) (e a)) as [-> | Da]; [lra |].
    destruct (Nat.eq_dec (e m) (e b)) as [-> | Db]; [lra |]. left. now apply Out.
Qed.

(* v is the place of [lo,hi] nearest to t, or farthest from it. *)
Definition along (near : Prop) (lo hi t v : R) : Prop :=
  (near -> v = clamp lo hi t) /\ (~ near -> v = far_end lo hi t).

(* d is the distance from c to the point of X that is nearest, or farthest, along x (nx) and y (ny). *)
Definition reach (nx ny : Prop) (c : point) (X : rect) (d : R) : Prop :=
  exists z, along nx (xlo X) (xhi X) (fst c) (fst z) /\ along ny (ylo X) (yhi X) (snd c) (snd z) /\ d = dist c z.

Lemma along_exists near lo hi t : exists v, along near lo hi t v.
Proof.
  destruct (classic near) as [H | H]; [exists (clamp lo hi t) | exists (far_end lo hi t)]; split; tauto.
Qed.

Lemma reach_exists nx ny c X : exists d, reach nx ny c X d.
Proof.
  destruct (along_exists nx (xlo X) (xhi X) (fst c)) as [x Hx].
  destruct (along_exists ny (ylo X) (yhi X) (snd c)) as [y Hy]. exists (dist c (x, y)), (x, y). now split.
Qed.

(* Where the fixed side is met at its nearest place, any place of another is no farther than its farthest one. *)
Lemma along_end (F : Prop) lo hi t v w : lo <= hi -> along F lo hi t v -> lo <= w <= hi -> (F -> w = clamp lo hi t) ->
  (t - w) * (t - w) <= (t - v) * (t - v).
Proof.
  intros O [N A] W H. destruct (classic F) as [Y | Y]; [rewrite (N Y), (H Y); lra | rewrite (A Y)].
  now apply far_end_spec.
Qed.

Lemma along_other (F : Prop) lo hi t v w : lo <= hi -> along (~ F) lo hi t v -> lo <= w <= hi ->
  (F -> w = far_end lo hi t) -> (t - v) * (t - v) <= (t - w) * (t - w).
Proof.
  intros O [N A] W H. destruct (classic F) as [Y | Y]; [rewrite A, (H Y) by tauto; lra | rewrite (N Y)].
  now apply clamp_spec.
Qed.

(* How far a narrowed end is, at most, and another site reaches, at least. *)
Lemma end_within N FX FY B B' k c d : (k < N)%nat -> narrowing N FX FY B B' -> reach (FX k) (FY k) c (B k) d ->
  ds c (B' k) <= d.
Proof.
  intros K W [v [X [Y ->]]].
  destruct (narrowing_point N FX FY B B' k (nearest c (B k)) K W (nearest_inside c (B k))) as [z [I [[Ix Iy] [Zx Zy]]]].
  apply Rle_trans with (dist c z); [now apply ds_le |]. apply dist_le. unfold dist2.
  pose proof (along_end _ _ _ _ _ _ (x_ordered (B k)) X Ix Zx).
  pose proof (along_end _ _ _ _ _ _ (y_ordered (B k)) Y Iy Zy). lra.
Qed.

Lemma other_reaches N FX FY B B' k c d : (k < N)%nat -> narrowing N FX FY B B' ->
  reach (~ FX k) (~ FY k) c (B k) d -> d <= dl c (B' k).
Proof.
  intros K W [v [X [Y ->]]].
  destruct (narrowing_point N FX FY B B' k (farthest c (B k)) K W (farthest_inside c (B k))) as [z [I [[Ix Iy] [Zx Zy]]]].
  apply Rle_trans with (dist c z); [| now apply le_dl]. apply dist_le. unfold dist2.
  pose proof (along_other _ _ _ _ _ _ (x_ordered (B k)) X Ix Zx).
  pose proof (along_other _ _ _ _ _ _ (y_ordered (B k)) Y Iy Zy). lra.
Qed.

Theorem disc_stays_possible N FX FY B B' i j c r : (i < N)%nat -> (j < N)%nat -> narrowing N FX FY B B' ->
  (forall k d, k = i \/ k = j -> reach (FX k) (FY k) c (B k) d -> d <= r) ->
  (forall k d, (k < N)%nat -> k <> i -> k <> j -> reach (~ FX k) (~ FY k) c (B k) d -> r <= d) ->
  possible N B' i j.
Proof.
  intros I J W Ends Others.
  assert (End : forall k, (k < N)%nat -> k = i \/ k = j -> ds c (B' k) <= r).
  { intros k K S. destruct (reach_exists (FX k) (FY k) c (B k)) as [d D]. pose proof (Ends k d S D).
    pose proof (end_within N FX FY B B' k c d K W D). lra. }
  left. exists c. intros k K Di Dj. destruct (reach_exists (~ FX k) (~ FY k) c (B k)) as [d D].
  pose proof (Others k d K Di Dj D). pose proof (other_reaches N FX FY B B' k c d K W D).
  pose proof (End i I (or_introl eq_refl)). pose proof (End j J (or_intror eq_refl)). split; lra.
Qed.

(* The representation of the site k: all of its rectangle, at a chosen place along the sides that stay. *)
Definition stands_for (FX FY : nat -> Prop) (B : sites) (k : nat) (Q : point -> Prop) : Prop :=
  exists q, inside q (B k) /\
    forall x, inside x (B k) -> (FX k -> fst x = fst q) -> (FY k -> snd x = snd q) -> Q x.

Lemma stands_in_narrowing N FX FY B B' k Q : (k < N)%nat -> narrowing N FX FY B B' -> stands_for FX FY B k Q ->
  exists x, Q x /\ inside x (B' k).
Proof.
  intros K W [q [I H]]. destruct (narrowing_point N FX FY B B' k q K W I) as [z [Iz [Jz [Zx Zy]]]].
  exists z. split; [now apply H | exact Iz].
Qed.

Section Four.
Variables (N : nat) (FX FY : nat -> Prop) (B B' : sites) (i j s0 s1 s2 s3 : nat) (Q0 Q1 Q2 Q3 : point -> Prop).
Variables (I : (i < N)%nat) (J : (j < N)%nat) (K2 : (s2 < N)%nat) (K3 : (s3 < N)%nat).
Variable narrow : narrowing N FX FY B B'.
Variables (E0 : s0 = i \/ s0 = j) (E1 : s1 = i \/ s1 = j) (D3 : s3 <> i /\ s3 <> j).
Variables (S0 : stands_for FX FY B s0 Q0) (S1 : stands_for FX FY B s1 Q1).
Variables (S2 : stands_for FX FY B s2 Q2) (S3 : stands_for FX FY B s3 Q3).

Lemma end_below s : s = i \/ s = j -> (s < N)%nat.
Proof. now intros [-> | ->]. Qed.

(* The disc of a witness. *)
Lemma witness_disc c : witness N B' i j c ->
  (forall s x, s = i \/ s = j -> inside x (B' s) -> dist c x <= Rmax (dl c (B' i)) (dl c (B' j))) /\
  (forall s x, (s < N)%nat -> s <> i -> s <> j -> inside x (B' s) -> Rmax (dl c (B' i)) (dl c (B' j)) < dist c x).
Proof.
  intros W. split.
  - intros s x [-> | ->] H; [apply Rle_trans with (dl c (B' i)); [now apply le_dl | apply Rmax_l] |
      apply Rle_trans with (dl c (B' j)); [now apply le_dl | apply Rmax_r]].
  - intros s x K Di Dj H. destruct (W s K Di Dj). pose proof (ds_le c (B' s) x H). apply Rmax_lub_lt; lra.
Qed.

Theorem crossing_refutes_legal : s2 <> i /\ s2 <> j ->
  (forall x y z w, Q0 x -> Q1 y -> Q2 z -> Q3 w -> (exists m, between m x y /\ between m z w) /\
    exists o r, circle o r x y z /\ dist o w < r) -> ~ legal N B' i j.
Proof.
  intros D2 H [c W]. destruct (witness_disc c W) as [In Out]. set (R := Rmax (dl c (B' i)) (dl c (B' j))) in *.
  destruct (stands_in_narrowing N FX FY B B' s0 Q0 (end_below _ E0) narrow S0) as [x [X Ix]].
  destruct (stands_in_narrowing N FX FY B B' s1 Q1 (end_below _ E1) narrow S1) as [y [Y Iy]].
  destruct (stands_in_narrowing N FX FY B B' s2 Q2 K2 narrow S2) as [z [Z Iz]].
  destruct (stands_in_narrowing N FX FY B B' s3 Q3 K3 narrow S3) as [w [Vw Iw]].
  destruct (H x y z w X Y Z Vw) as [[m [[s [Ts Es]] [t [Tt Et]]]] [o [r [[Ox [Oy Oz]] Ow]]]].
  assert (R0 : 0 <= R) by (apply Rle_trans with (dist c x); [apply dist_nonneg | now apply (In s0)]).
  pose proof (power_le c R x (In s0 x E0 Ix)) as Px. pose proof (power_le c R y (In s1 y E1 Iy)) as Py.
  pose proof (power_gt c R z R0 (Out s2 z K2 (proj1 D2) (proj2 D2) Iz)) as Pz.
  pose proof (power_gt c R w R0 (Out s3 w K3 (proj1 D3) (proj2 D3) Iw)) as Pw.
  pose proof (power_zero o r x Ox). pose proof (power_zero o r y Oy). pose proof (power_zero o r z Oz).
  pose proof (power_lt o r w Ow). pose proof (radical_mix c R o r s x y) as A. pose proof (radical_mix c R o r t z w) as C.
  rewrite <- Es in A. rewrite <- Et in C. unfold radical in A, C.
  set (u := power c R m - power o r m) in *.
  assert (u <= 0).
  { rewrite A. assert (0 <= (1 - s) * - (power c R x - power o r x)) by (apply Rmult_le_pos; lra).
    assert (0 <= s * - (power c R y - power o r y)) by (apply Rmult_le_pos; lra). lra. }
  assert (0 < u); [| lra]. rewrite C.
  set (a := power c R z - power o r z) in *. set (b := power c R w - power o r w) in *.
  assert (Pa : 0 < a) by (unfold a; lra). assert (Pb : 0 < b) by (unfold b; lra).
  clearbody a b. clear - Tt Pa Pb. nra.
Qed.

(* z is in the triangle of three points: on a segment from one to a point between the two others. *)
Theorem triangle_refutes_legal : s2 = i \/ s2 = j ->
  (forall x y z w, Q0 x -> Q1 y -> Q2 z -> Q3 w -> exists m, between m x y /\ between w m z) -> ~ legal N B' i j.
Proof.
  intros E2 H [c W]. destruct (witness_disc c W) as [In Out].
  destruct (stands_in_narrowing N FX FY B B' s0 Q0 (end_below _ E0) narrow S0) as [x [X Ix]].
  destruct (stands_in_narrowing N FX FY B B' s1 Q1 (end_below _ E1) narrow S1) as [y [Y Iy]].
  destruct (stands_in_narrowing N FX FY B B' s2 Q2 K2 narrow S2) as [z [Z Iz]].
  destruct (stands_in_narrowing N FX FY B B' s3 Q3 K3 narrow S3) as [w [Vw Iw]].
  destruct (H x y z w X Y Z Vw) as [m [[s [Ts Es]] [t [Tt Et]]]].
  pose proof (Out s3 w K3 (proj1 D3) (proj2 D3) Iw) as O. apply Rlt_not_le in O. apply O. rewrite Et.
  apply disc_convex; [exact Tt | rewrite Es; apply disc_convex; [exact Ts | now apply (In s0) | now apply (In s1)] |
    now apply (In s2)].
Qed.
End Four.

(* ---- firm rectangles [SET-2] ---- *)

(* X is Y less e on each side. *)
Definition less_on_each_side (e : R) (X Y : rect) : Prop :=
  xlo X = xlo Y + e /\ xhi X = xhi Y - e /\ ylo X = ylo Y + e /\ yhi X = yhi Y - e.

Lemma coordinate_le_dist x y : Rabs (fst x - fst y) <= dist x y /\ Rabs (snd x - snd y) <= dist x y.
Proof.
  pose proof (dist_nonneg x y) as P. pose proof (dist_sq x y) as E. unfold dist2 in E.
  pose proof (Rle_0_sqr (fst x - fst y)) as A. pose proof (Rle_0_sqr (snd x - snd y)) as D. unfold Rsqr in A, D.
  split; apply le_of_squares; try exact P; rewrite <- Rabs_mult, Rabs_pos_eq by lra; lra.
Qed.

Lemma around_inside e X Y x y : less_on_each_side e X Y -> inside x X -> dist x y <= e -> inside y Y.
Proof.
  intros [A [D [E G]]] [[H1 H2] [H3 H4]] L. destruct (coordinate_le_dist x y) as [U V].
  apply Rle_trans with (r3 := e) in U; [| exact L]. apply Rle_trans with (r3 := e) in V; [| exact L].
  assert (K : forall r, Rabs r <= e -> - e <= r <= e) by (intros r; unfold Rabs; destruct (Rcase_abs r); lra).
  apply K in U. apply K in V. unfold inside. lra.
Qed.

Lemma dl_less e X Y c : 0 <= e -> less_on_each_side e X Y -> dl c X <= dl c Y - e.
Proof.
  intros E H. set (x := farthest c X). assert (Ix : inside x X) by apply farthest_inside.
  destruct (Req_dec (dist c x) 0) as [Z | Z].
  - assert (O : dist x (fst x + e, snd x) = e).
    { unfold dist, dist2. simpl. replace (_ + _) with (e * e) by ring. now apply sqrt_square. }
    pose proof (le_dl c Y _ (around_inside e X Y x _ H Ix (Req_le _ _ O))) as L.
    rewrite (dist_zero c x Z), O in L. change (dl c X) with (dist c x). rewrite Z. rewrite (dist_zero c x Z). lra.
  - assert (P : 0 < dist c x) by (pose proof (dist_nonneg c x); lra).
    set (t := 1 + e / dist c x). assert (T : 0 <= e / dist c x).
    { apply Rmult_le_pos; [exact E |]. left. now apply Rinv_0_lt_compat. }
    assert (M : dist x (mix t c x) = e).
    { rewrite <- (mix_1 c x) at 1. rewrite dist_mix_mix. replace (1 - t) with (- (e / dist c x)) by (unfold t; ring).
      rewrite Rabs_Ropp, Rabs_pos_eq by exact T. field. lra. }
    pose proof (le_dl c Y _ (around_inside e X Y x _ H Ix (Req_le _ _ M))) as L.
    rewrite dist_mix_left in L by (unfold t; lra). change (dl c X) with (dist c x).
    replace (t * dist c x) with (dist c x + e) in L by (unfold t; field; lra). lra.
Qed.

Lemma ds_more e X Y c : 0 <= e -> less_on_each_side e X Y -> ~ inside c Y -> ds c Y + e <= ds c X.
Proof.
  intros E H Out. set (x := nearest c X). assert (Ix : inside x X) by apply nearest_inside.
  assert (P : e < dist x c).
  { apply Rnot_le_lt. intros L. now apply Out, (around_inside e X Y x). }
  set (t := e / dist x c). assert (T : 0 <= t <= 1).
  { unfold t. split; [apply Rmult_le_pos; [exact E |]; left; apply Rinv_0_lt_compat; lra |].
    apply (Rmult_le_reg_r (dist x c)); [lra |]. replace (e / dist x c * dist x c) with e by (field; lra). lra. }
  assert (M : dist x (mix t x c) = e) by (rewrite dist_mix_left by lra; unfold t; field; lra).
  pose proof (ds_le c Y _ (around_inside e X Y x _ H Ix (Req_le _ _ M))) as L.
  rewrite dist_sym, dist_mix_right in L by lra. change (ds c X) with (dist c x). rewrite (dist_sym c x).
  replace ((1 - t) * dist x c) with (dist x c - e) in L by (unfold t; field; lra). lra.
Qed.

Definition norm (u : point) : R := dist u (0, 0).

Lemma dot_near u x y : dot u x - dot u y <= norm u * dist x y.
Proof.
  apply le_of_squares; [apply Rmult_le_pos; apply dist_nonneg |]. unfold norm.
  replace (dist u (0, 0) * dist x y * (dist u (0, 0) * dist x y)) with
    ((dist u (0, 0) * dist u (0, 0)) * (dist x y * dist x y)) by ring.
  rewrite !dist_sq. unfold dot, dist2. simpl.
  pose proof (Rle_0_sqr (fst u * (snd x - snd y) - snd u * (fst x - fst y))) as S. unfold Rsqr in S. lra.
Qed.

Lemma highest_more e X Y u : 0 <= e -> u <> (0, 0) -> less_on_each_side e X Y ->
  dot u (highest u X) + norm u * e <= dot u (highest u Y).
Proof.
  intros E U H. set (x := highest u X). assert (Ix : inside x X) by apply highest_spec.
  assert (P : 0 < norm u) by now apply dist_pos.
  assert (S : norm u * norm u = fst u * fst u + snd u * snd u) by (unfold norm; rewrite dist_sq; unfold dist2; simpl; ring).
  set (t := e / norm u). set (y := (fst x + t * fst u, snd x + t * snd u)).
  assert (Y0 : dist x y = e).
  { unfold dist. replace (dist2 x y) with (e * e); [now apply sqrt_square |].
    transitivity (t * t * (norm u * norm u)); [unfold t; field; lra | rewrite S; unfold y, dist2; simpl; ring]. }
  destruct (highest_spec u Y) as [_ Hi]. specialize (Hi y (around_inside e X Y x y H Ix (Req_le _ _ Y0))).
  replace (dot u y) with (dot u x + t * (norm u * norm u)) in Hi by (rewrite S; unfold y, dot; simpl; ring).
  replace (t * (norm u * norm u)) with (norm u * e) in Hi by (unfold t; field; lra). exact Hi.
Qed.

(* Two points of the site k that are at one place along the sides that stay. *)
Definition differ_narrowed (FX FY : nat -> Prop) (k : nat) (x y : point) : Prop :=
  (FX k -> fst x = fst y) /\ (FY k -> snd x = snd y).

Section Firm.
Variables (N : nat) (FX FY firm : nat -> Prop) (B B' C : sites) (q : nat -> point) (e : R) (i j : nat).
Variables (I : (i < N)%nat) (J : (j < N)%nat) (Pe : 0 <= e).
Variable narrow : narrowing N FX FY B B'.
Variable small_ones : forall k x y, (k < N)%nat -> inside x (B k) -> inside y (B k) -> differ_narrowed FX FY k x y ->
  dist x y <= e.
Variable firm_fixed : forall k, (k < N)%nat -> firm k -> FX k /\ FY k /\ less_on_each_side e (C k) (B k).
(* The others: at a place q along the sides that can be narrowed. *)
Variable others : forall k x, (k < N)%nat -> ~ firm k -> inside x (C k) ->
  inside x (B k) /\ (~ FX k -> fst x = fst (q k)) /\ (~ FY k -> snd x = snd (q k)).
Variables (Fi : firm i) (Fj : firm j).

(* A point of the representation of a site is near one of the narrowed rectangle. *)
Lemma near_narrowed k x : (k < N)%nat -> inside x (C k) -> exists z, inside z (B' k) /\ dist x z <= e.
Proof.
  intros K H. destruct (classic (firm k)) as [T | T].
  - destruct (firm_fixed k K T) as [Fx [Fy L]]. exists x. rewrite dist_self. split; [| lra].
    apply (narrowing_core N FX FY B B' k K narrow Fx Fy), (around_inside e (C k) (B k) x x L H). rewrite dist_self. lra.
  - destruct (others k x K T H) as [Hb _].
    destruct (narrowing_point N FX FY B B' k x K narrow Hb) as [z [Iz [Jz [Zx Zy]]]]. exists z. split; [exact Iz |].
    apply (small_ones k x z K Hb Jz). split; intros Y; symmetry; auto.
Qed.

Lemma end_shrinks k c : (k < N)%nat -> firm k -> dl c (C k) <= dl c (B' k) - e.
Proof.
  intros K H. destruct (firm_fixed k K H) as [Fx [Fy L]]. pose proof (dl_less e _ _ c Pe L).
  pose proof (dl_monotone c _ _ (narrowing_core N FX FY B B' k K narrow Fx Fy)). lra.
Qed.

Theorem firm_refutes_legal : ~ legal N C i j -> ~ legal N B' i j.
Proof.
  intros H [c W]. apply H. exists c. intros k K Di Dj. destruct (W k K Di Dj) as [Wi Wj].
  pose proof (end_shrinks i c I Fi). pose proof (end_shrinks j c J Fj).
  destruct (near_narrowed k (nearest c (C k)) K (nearest_inside c (C k))) as [z [Iz D]].
  pose proof (ds_le c _ _ Iz). pose proof (dist_triangle c (nearest c (C k)) z).
  assert (ds c (B' k) - e <= ds c (C k)) by (change (ds c (C k)) with (dist c (nearest c (C k))); lra). lra.
Qed.

Theorem firm_stays_possible : possible N C i j -> possible N B' i j.
Proof.
  assert (Same : forall k c, (k < N)%nat -> firm k -> ds c (B' k) <= ds c (B k)).
  { intros k c K T. destruct (firm_fixed k K T) as [Fx [Fy _]].
    apply ds_monotone, (narrowing_core N FX FY B B' k K narrow Fx Fy). }
  destruct (firm_fixed i I Fi) as [_ [_ Li]]. destruct (firm_fixed j J Fj) as [_ [_ Lj]].
  assert (E : 0 <= e) by lra. intros [[c H] | [u [U H]]].
  - left. exists c. intros k K Di Dj. destruct (H k K Di Dj) as [Hi Hj].
    pose proof (Same i c I Fi) as Si. pose proof (Same j c J Fj) as Sj.
    destruct (near_narrowed k (farthest c (C k)) K (farthest_inside c (C k))) as [z [Iz D]].
    pose proof (le_dl c _ _ Iz). pose proof (dist_triangle c z (farthest c (C k))). rewrite (dist_sym z) in *.
    assert (Dl : dl c (C k) - e <= dl c (B' k)) by (change (dl c (C k)) with (dist c (farthest c (C k))); lra).
    assert (Zero : forall X, inside c X -> ds c X <= 0) by (intros X X0; pose proof (ds_le c X c X0); rewrite dist_self in *; lra).
    pose proof (dl_nonneg c (B' k)). pose proof (ds_nonneg c (B i)). pose proof (ds_nonneg c (B j)).
    destruct (classic (inside c (B i))) as [Ci | Ci]; destruct (classic (inside c (B j))) as [Cj | Cj].
    + pose proof (Zero _ Ci). pose proof (Zero _ Cj). lra.
    + pose proof (Zero _ Ci). pose proof (ds_more e _ _ c E Lj Cj). lra.
    + pose proof (Zero _ Cj). pose proof (ds_more e _ _ c E Li Ci). lra.
    + pose proof (ds_more e _ _ c E Lj Cj). pose proof (ds_more e _ _ c E Li Ci). lra.
  - right. exists u. split; [exact U |]. intros s k Ls Ss K. pose proof (H s k Ls Ss K) as G.
    assert (Ts : firm s) by (destruct Ss as [-> | ->]; assumption).
    destruct (firm_fixed s Ls Ts) as [Fx [Fy L]]. pose proof (highest_more e _ _ u E U L) as Hi.
    assert (dot u (highest u (B s)) <= dot u (highest u (B' s))).
    { apply highest_spec, (narrowing_core N FX FY B B' s Ls narrow Fx Fy), highest_spec. }
    destruct (near_narrowed k (lowest u (C k)) K (proj1 (lowest_spec u (C k)))) as [z [Iz D]].
    assert (0 <= norm u) by apply dist_nonneg. pose proof (proj2 (lowest_spec u (B' k)) z Iz).
    pose proof (dot_near u z (lowest u (C k))). rewrite dist_sym in D.
    assert (norm u * dist z (lowest u (C k)) <= norm u * e) by (apply Rmult_le_compat_l; lra). lra.
Qed.
End Firm.
