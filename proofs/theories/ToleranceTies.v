(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Motions when there are ties: sites of undecided faces, three or more on an empty circle or on one line of the hull,
   stay where they are, and strictly Delaunay edges are not lost. Then every pair keeps its status [TOL-5] [TOL-6]. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc PartialDisc TiedFace Crossing Path Fan
  Triangulation Tolerance ToleranceNear ToleranceStays.
Open Scope R_scope.

(* Seen from a place z of a circle, its other places are in an order; the first and the last of them. *)
Lemma turn_by_key z o a b : dist2 o a = dist2 o z -> dist2 o b = dist2 o z ->
  let n := (fst o - fst z, snd o - snd z) in let u := (- snd n, fst n) in let f x := (fst x - fst z, snd x - snd z) in
  dot n n * orient z a b = dot n (f a) * dot u (f b) - dot u (f a) * dot n (f b) /\ dot n (f a) = dist2 z a / 2.
Proof.
  intros A B. split; [unfold dot, orient; simpl; ring |]. unfold dist2, dot in *. simpl. lra.
Qed.

Lemma first_and_last N p (S : nat -> Prop) z o : (exists k, (k < N)%nat /\ S k) -> z <> o ->
  (forall k, (k < N)%nat -> S k -> p k <> z /\ dist2 o (p k) = dist2 o z) ->
  exists i j, (i < N)%nat /\ S i /\ (j < N)%nat /\ S j /\
    forall k, (k < N)%nat -> S k -> 0 <= orient z (p i) (p k) /\ 0 <= orient z (p k) (p j).
Proof.
  intros E Zo On. set (n := (fst o - fst z, snd o - snd z)). set (u := (- snd n, fst n)).
  set (f x := (fst x - fst z, snd x - snd z) : point). set (key k := dot u (f (p k)) / dot n (f (p k))).
  assert (Nn : 0 < dot n n).
  { replace (dot n n) with (dist2 z o) by (unfold dot, n, dist2; simpl; ring). rewrite <- dist_sq.
    pose proof (dist_pos _ _ Zo). nra. }
  assert (Order : forall a b, (a < N)%nat -> S a -> (b < N)%nat -> S b -> key a <= key b -> 0 <= orient z (p a) (p b)).
  { intros a b A Sa B Sb L. destruct (On a A Sa) as [Da Ea]. destruct (On b B Sb) as [Db Eb].
    destruct (turn_by_key z o (p a) (p b) Ea Eb) as [T Ha]. destruct (turn_by_key z o (p b) (p a) Eb Ea) as [_ Hb].
    cbv zeta in T, Ha, Hb. fold n in T, Ha, Hb. fold u in T. fold (f (p a)) in T, Ha. fold (f (p b)) in T, Hb.
    assert (Pa : 0 < dot n (f (p a))).
    { rewrite Ha, <- dist_sq. pose proof (dist_pos z (p a) (not_eq_sym Da)). nra. }
    assert (Pb : 0 < dot n (f (p b))).
    { rewrite Hb, <- dist_sq. pose proof (dist_pos z (p b) (not_eq_sym Db)). nra. }
    assert (Ka : dot u (f (p a)) = key a * dot n (f (p a))) by (unfold key; field; lra).
    assert (Kb : dot u (f (p b)) = key b * dot n (f (p b))) by (unfold key; field; lra).
    rewrite Ka, Kb in T. apply (Rmult_le_reg_l (dot n n)); [exact Nn |]. rewrite T, Rmult_0_r.
    replace (_ - _) with (dot n (f (p a)) * dot n (f (p b)) * (key b - key a)) by ring.
    apply Rmult_le_pos; [| lra]. left. now apply Rmult_lt_0_compat. }
  destruct (finite_min S key N E) as [i [I [Si Li]]]. destruct (finite_max S key N E) as [j [J [Sj Lj]]].
  exists i, j. repeat split; auto.
Qed.

Lemma strict_is_weak N p a b : (a < N)%nat -> (b < N)%nat -> strict_edge N p a b -> weak_edge N p a b.
Proof.
  intros A B [c [E H]]. left.
  assert (D : empty_disc N p (pair a b) c (dist c (p a))).
  { split; [intros k _ [-> | ->]; auto |]. intros k K. destruct (Nat.eq_dec k a) as [-> | Da]; [lra |].
    destruct (Nat.eq_dec k b) as [-> | Db]; [lra |]. now left; apply H. }
  destruct (Rle_lt_or_eq_dec _ _ (dist_nonneg c (p a))) as [P | Z]; [now exists c, (dist c (p a)) |].
  rewrite <- Z in D. destruct (positive_disc N p (pair a b) c D) as [c' [r [P D']]]. now exists c', r.
Qed.

(* Two sites on a line with no site beyond it, and no site between them. *)
Lemma hull_pair_is_strict N p u v a b : u <> v -> (forall k, (k < N)%nat -> 0 <= orient u v (p k)) ->
  orient u v (p a) = 0 -> orient u v (p b) = 0 ->
  (forall k l, (k < N)%nat -> (l < N)%nat -> k <> l -> p k <> p l) -> (a < N)%nat -> (b < N)%nat -> a <> b ->
  (forall k, (k < N)%nat -> k <> a -> k <> b -> ~ between (p k) (p a) (p b)) -> strict_edge N p a b.
Proof.
  intros Duv Left Za Zb Diff A B Dab Free.
  set (E k := (fst (p k) - fst (p a)) * (fst (p k) - fst (p b)) + (snd (p k) - snd (p a)) * (snd (p k) - snd (p b))).
  assert (Flat : forall k, orient u v (p k) = 0 -> orient (p a) (p b) (p k) = 0).
  { intros k Z. apply (collinear (snd v - snd u, - (fst v - fst u))).
    - intros F. apply Duv. injection F as F1 F2. destruct u, v. simpl in *. f_equal; lra.
    - unfold orient in *. unfold dot. simpl. lra.
    - unfold orient in *. unfold dot. simpl. lra. }
  destruct (small_finite (fun k d => k <> a -> k <> b -> 0 < d * E k + 2 * orient u v (p k)) N) as [d [D L]].
  { intros k K. destruct (classic (k <> a /\ k <> b)) as [[Da Db] | Dn];
      [| exists 1; split; [lra |]; intros d _ Da Db; now elim Dn].
    destruct (Left k K) as [P | Z].
    - set (h := orient u v (p k)) in *. pose proof (Rabs_pos (E k)) as Q. exists (h / (Rabs (E k) + 1)).
      assert (H : 0 < h / (Rabs (E k) + 1)) by (apply Rdiv_lt_0_compat; lra). split; [exact H |].
      intros d [D0 D1] _ _. assert (Y : h / (Rabs (E k) + 1) * (Rabs (E k) + 1) = h) by (field; lra).
      pose proof (Rle_abs (- E k)) as X. rewrite Rabs_Ropp in X. nra.
    - exists 1. split; [lra |]. intros d [D0 _] _ _. rewrite <- Z.
      assert (0 < E k); [| nra]. pose proof (Diff k a K A Da) as Na. pose proof (Diff k b K B Db) as Nb.
      pose proof (dist_pos _ _ Na) as Pa. pose proof (dist_pos _ _ Nb) as Pb.
      assert (Qa : 0 < dist2 (p k) (p a)) by (rewrite <- dist_sq; nra).
      assert (Qb : 0 < dist2 (p k) (p b)) by (rewrite <- dist_sq; nra).
      destruct (one_between _ _ _ (Flat k (eq_sym Z))) as [[t [T X]] | [[t [T X]] | X]]; [| | now elim (Free k K Da Db)].
      + assert (T1 : t <> 1) by (intros ->; rewrite mix_1 in X; now apply Na).
        assert (F : E k = (1 - t) * dist2 (p k) (p b)) by (unfold E; rewrite X; unfold dist2, mix; simpl; ring).
        rewrite F. apply Rmult_lt_0_compat; lra.
      + assert (T1 : t <> 1) by (intros ->; rewrite mix_1 in X; now apply Nb).
        assert (F : E k = (1 - t) * dist2 (p k) (p a)) by (unfold E; rewrite X; unfold dist2, mix; simpl; ring).
        rewrite F. apply Rmult_lt_0_compat; lra. }
  specialize (L d (conj D (Rle_refl d))).
  set (c := (fst (p a) / 2 + fst (p b) / 2 + / d * (snd v - snd u), snd (p a) / 2 + snd (p b) / 2 - / d * (fst v - fst u))).
  assert (C : forall k, dist2 c (p k) - dist2 c (p a) = E k + 2 * / d * (orient u v (p k) - orient u v (p a)))
    by (intros k; unfold c, E, dist2, orient; simpl; field; lra).
  exists c. split.
  - apply dist_eq. pose proof (C b) as X. rewrite Za, Zb in X. replace (E b) with 0 in X by (unfold E; ring). lra.
  - intros k K Da Db. apply dist_lt. pose proof (C k) as X. rewrite Za in X. pose proof (L k K Da Db) as Y.
    assert (0 < / d) by now apply Rinv_0_lt_compat.
    assert (0 < / d * (d * E k + 2 * orient u v (p k))) by now apply Rmult_lt_0_compat.
    replace (/ d * (d * E k + 2 * orient u v (p k))) with (E k + 2 * / d * (orient u v (p k) - 0)) in * by (field; lra). lra.
Qed.

(* Three or more sites on an empty circle, which stay where they are. *)
Definition staying_circle (N : nat) (p q : nat -> point) (o : point) (r : R) : Prop :=
  (forall k, (k < N)%nat -> r <= dist o (p k)) /\ (forall k, (k < N)%nat -> dist o (p k) = r -> p k = q k) /\
  exists a b c, (a < N)%nat /\ (b < N)%nat /\ (c < N)%nat /\ a <> b /\ a <> c /\ b <> c /\
    dist o (p a) = r /\ dist o (p b) = r /\ dist o (p c) = r.

(* What a pair is: strictly Delaunay, weakly only (a tie), or no edge. *)
Definition same_status (N : nat) (p q : nat -> point) (a b : nat) : Prop :=
  (strict_edge N p a b <-> strict_edge N q a b) /\ (weak_edge N p a b <-> weak_edge N q a b).

Section Ties.
Variables (N : nat) (p q : nat -> point) (faces : nat -> list (nat * nat)) (rim edge : nat -> nat -> Prop).
Variable sk : skeleton N p faces rim edge.
Variable different : forall k l, (k < N)%nat -> (l < N)%nat -> k <> l -> p k <> p l.
Let x (t : R) (k : nat) : point := path p q t k.

Variable strict_stays : forall i j, (i < N)%nat -> (j < N)%nat -> i <> j -> strict_edge N p i j ->
  forall t, 0 <= t <= 1 -> strict_edge N (x t) i j.
(* Circles of undecided faces: each edge drawn in such a face has its ends on one of them. *)
Variable tied : point -> R -> Prop.
Variable tied_stays : forall o r, tied o r -> staying_circle N p q o r.
Variable edges : forall i j, edge i j -> (i < N)%nat /\ (j < N)%nat /\ i <> j /\ (strict_edge N p i j \/
  exists o r, tied o r /\ dist o (p i) = r /\ dist o (p j) = r).
Variable corners : forall u v w, rim u v -> rim v w -> flat p q u v w \/
  forall t, 0 <= t <= 1 -> ~ between (x t v) (x t u) (x t w).

Lemma distance_continuous o k : continuity (fun t => dist o (x t k)).
Proof.
  apply (lipschitz_continuous (dist (p k) (q k))). intros s t. unfold x, path.
  pose proof (dist_mix_mix s t (p k) (q k)) as M. rewrite Rmult_comm, <- M.
  pose proof (dist_triangle o (mix s (p k) (q k)) (mix t (p k) (q k))) as A.
  pose proof (dist_triangle o (mix t (p k) (q k)) (mix s (p k) (q k))) as B.
  rewrite (dist_sym (mix t (p k) (q k))) in B. lra.
Qed.

(* No site comes into the circle: each of its arcs is in the disc of a side of the polygon, which is an edge. *)
Lemma nobody_on_circle o r k s : staying_circle N p q o r -> (k < N)%nat -> dist o (p k) <> r -> 0 <= s <= 1 ->
  dist o (x s k) <> r.
Proof.
  intros [Out [Stay [a [b [c [A [B [C [Dab [Dac [Dbc [Ea [Eb Ec]]]]]]]]]]]]] K Nk S Z. set (z := x s k) in *.
  set (on l := dist o (p l) = r).
  assert (At : forall l, (l < N)%nat -> on l -> x s l = p l) by (intros l L O; now apply stays_at, Stay).
  assert (Sq : forall l, on l -> dist2 o (p l) = dist2 o z) by (intros l O; rewrite <- !dist_sq, O, Z; ring).
  assert (Zo : z <> o).
  { intros E. apply (different a b A B Dab). rewrite E, dist_self in Z. rewrite <- Z in Ea, Eb.
    now rewrite <- (dist_zero _ _ Ea), <- (dist_zero _ _ Eb). }
  destruct (classic (exists v, (v < N)%nat /\ on v /\ p v = z)) as [[v [V [Ov Ev]]] | Ne].
  - (* at the place of one of its sites *)
    destruct (first_and_last N p (fun l => on l /\ l <> v) z o) as [i [last [I [[Oi Di] [_ [_ Order]]]]]].
    + destruct (Nat.eq_dec a v) as [-> | Y]; [exists b; auto | now exists a].
    + exact Zo.
    + intros l L [O D]. split; [rewrite <- Ev; now apply different | now apply Sq].
    + assert (E : strict_edge N p v i).
      { apply (side_is_strict N p different v i o r); auto. intros l L O. rewrite Ev.
        destruct (Nat.eq_dec l v) as [-> | D]; [rewrite Ev; unfold orient; lra | now apply (Order l L)]. }
      destruct (strict_stays v i V I (not_eq_sym Di) E s S) as [w [_ H]].
      assert (Kv : k <> v) by (intros ->; contradiction). assert (Ki : k <> i) by (intros ->; contradiction).
      pose proof (H k K Kv Ki) as L. rewrite (At v V Ov), Ev in L. fold z in L. lra.
  - (* between two neighbours i and j *)
    assert (Nz : forall l, (l < N)%nat -> on l -> p l <> z) by (intros l L O E; apply Ne; now exists l).
    destruct (first_and_last N p on z o) as [i [j [I [Oi [J [Oj Order]]]]]]; [now exists a | exact Zo | auto |].
    assert (Strict : forall l m, (l < N)%nat -> on l -> (m < N)%nat -> on m -> l <> m ->
      0 <= orient z (p l) (p m) -> 0 < orient z (p l) (p m)).
    { intros l m L Ol M Om D P. destruct P as [P | P]; [exact P | exfalso].
      destruct (chord_ends o z (p l) (p m)) as [Y | Y]; auto.
      - apply not_eq_sym. now apply Nz.
      - now apply (Nz m M Om).
      - now apply (different m l M L (not_eq_sym D)). }
    assert (Dij : i <> j).
    { intros ->. assert (W : exists l, (l < N)%nat /\ on l /\ l <> j).
      { destruct (Nat.eq_dec a j) as [-> | Y]; [exists b; auto | now exists a]. }
      destruct W as [l [L [Ol Dl]]]. destruct (Order l L Ol) as [O1 O2].
      pose proof (Strict j l J Oj L Ol (not_eq_sym Dl) O1). unfold orient in *. lra. }
    destruct (Order j J Oj) as [Oij _]. pose proof (Strict i j I Oi J Oj Dij Oij) as P.
    assert (Third : exists m, (m < N)%nat /\ on m /\ m <> i /\ m <> j).
    { destruct (classic (a <> i /\ a <> j)) as [[Y1 Y2] | Y]; [now exists a |].
      destruct (classic (b <> i /\ b <> j)) as [[Y1 Y2] | Y']; [now exists b |]. exists c. repeat split; auto; lia. }
    (* a site seen between them from z is beyond the line from i to j *)
    assert (Far : forall m, (m < N)%nat -> on m -> m <> i -> m <> j -> 0 < orient z (p m) (p j) /\
      0 < orient z (p i) (p m) /\ orient (p m) (p i) (p j) < 0).
    { intros m M Om Di Dj. destruct (Order m M Om) as [O1 O2].
      pose proof (Strict i m I Oi M Om (not_eq_sym Di) O1) as P1. pose proof (Strict m j M Om J Oj Dj O2) as P2.
      split; [exact P2 |]. split; [exact P1 |].
      pose proof (cocircular_barycentric o r z (p i) (p j) (p m) (conj Z (conj Oi Oj)) Om) as Q.
      pose proof (dist_pos _ _ (different i j I J Dij)) as Pij.
      assert (Pij2 : 0 < dist2 (p i) (p j)) by (rewrite <- dist_sq; nra).
      pose proof (dist2_nonneg z (p i)). pose proof (dist2_nonneg z (p j)).
      apply Rnot_le_lt. intros Y. set (u := orient z (p m) (p j)) in *. set (w := orient z (p i) (p m)) in *.
      set (h := orient (p m) (p i) (p j)) in *. assert (0 < u * w * dist2 (p i) (p j)) by (repeat apply Rmult_lt_0_compat; lra).
      assert (0 <= h * u * dist2 z (p i)) by (repeat apply Rmult_le_pos; lra).
      assert (0 <= h * w * dist2 z (p j)) by (repeat apply Rmult_le_pos; lra). lra. }
    assert (E : strict_edge N p j i).
    { apply (side_is_strict N p different j i o r); auto. intros l L Ol.
      destruct (Nat.eq_dec l i) as [-> | Di]; [unfold orient; lra |].
      destruct (Nat.eq_dec l j) as [-> | Dj]; [unfold orient; lra |].
      destruct (Far l L Ol Di Dj) as [_ [_ Y]]. unfold orient in *. lra. }
    destruct (strict_stays j i J I (not_eq_sym Dij) E s S) as [w [Ew H]]. destruct Third as [m [M [Om [Di Dj]]]].
    destruct (Far m M Om Di Dj) as [P1 [P2 Y]].
    assert (Ki : k <> i) by (intros ->; contradiction). assert (Kj : k <> j) by (intros ->; contradiction).
    pose proof (H k K Kj Ki) as Hk. pose proof (H m M Dj Di) as Hm. fold z in Hk.
    rewrite (At m M Om), (At j J Oj) in *. rewrite (At i I Oi) in Ew. set (d := dist w (p j)) in *.
    assert (D0 : 0 <= d) by apply dist_nonneg.
    pose proof (radical_barycentric w d o r z (p i) (p j) (p m)) as Q. unfold radical in Q.
    rewrite (power_zero o r z Z), (power_zero o r (p i) Oi), (power_zero o r (p j) Oj), (power_zero o r (p m) Om) in Q.
    rewrite (power_zero w d (p i)), (power_zero w d (p j)) in Q by (reflexivity || now symmetry).
    pose proof (power_gt w d z D0 Hk) as Pz. pose proof (power_gt w d (p m) D0 Hm) as Pm.
    assert (0 < orient z (p i) (p j) * (power w d (p m) - 0)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < - orient (p m) (p i) (p j) * (power w d z - 0)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma circle_stays o r k t : staying_circle N p q o r -> (k < N)%nat -> 0 <= t <= 1 ->
  (dist o (p k) = r -> x t k = p k) /\ (dist o (p k) <> r -> r < dist o (x t k)).
Proof.
  intros C K T. pose proof C as [Out [Stay _]]. split; [intros E; now apply stays_at, Stay |]. intros E.
  pose proof (Out k K) as L.
  assert (0 < dist o (x t k) - r); [| lra].
  apply (nonzero_stays (fun s => dist o (x s k) - r)); [| | | exact T].
  - apply (continuity_minus (fun s => dist o (x s k)) (fct_cte r)); [apply distance_continuous | apply continuity_const; now intros].
  - unfold x. rewrite at_0. lra.
  - intros s S Z. apply (nobody_on_circle o r k s C K E S). lra.
Qed.

Lemma edges_are_free t i j k : 0 <= t <= 1 -> edge i j -> (k < N)%nat -> k <> i -> k <> j ->
  ~ between (x t k) (x t i) (x t j).
Proof.
  intros T E K Di Dj. destruct (edges i j E) as [I [J [Dij [St | [o [r [C [Ei Ej]]]]]]]]; [| apply tied_stays in C].
  - apply edge_is_free with N; auto.
  - intros [s [S Z]]. destruct (circle_stays o r i t C I T) as [Ai _]. destruct (circle_stays o r j t C J T) as [Aj _].
    rewrite (Ai Ei), (Aj Ej) in Z. destruct (circle_stays o r k t C K T) as [Ak Bk].
    pose proof (disc_convex s o r (p i) (p j) S ltac:(lra) ltac:(lra)) as L. rewrite <- Z in L.
    destruct (Req_dec (dist o (p k)) r) as [On | Off]; [| pose proof (Bk Off); lra]. rewrite (Ak On) in Z.
    destruct (chord_ends o (p i) (p j) (p k)) as [Y | Y].
    + rewrite Z. unfold orient, mix. simpl. ring.
    + now apply different.
    + rewrite <- !dist_sq, Ei, Ej. ring.
    + rewrite <- !dist_sq, Ei, On. ring.
    + now apply (different k i K I).
    + now apply (different k j K J).
Qed.

(* Pairs of an undecided face: possible before and after; edges of all choices where they are sides of it. *)
Lemma circle_pair o r a b : staying_circle N p q o r -> (a < N)%nat -> (b < N)%nat -> a <> b ->
  dist o (p a) = r -> dist o (p b) = r -> ~ strict_edge N p a b -> same_status N p q a b.
Proof.
  intros C A B D Ea Eb Ns. pose proof C as [Out [Stay _]]. pose proof (different a b A B D) as Ne.
  assert (R0 : 0 < r).
  { destruct (Rle_lt_or_eq_dec 0 r) as [Y | Y]; [rewrite <- Ea; apply dist_nonneg | exact Y |]. exfalso. apply Ne. rewrite <- Y in Ea, Eb.
    now rewrite <- (dist_zero _ _ Ea), <- (dist_zero _ _ Eb). }
  assert (Qk : forall k, (k < N)%nat -> r <= dist o (q k)).
  { intros k K. destruct (circle_stays o r k 1 C K ltac:(lra)) as [On Off]. unfold x in *. rewrite at_1 in *.
    destruct (Req_dec (dist o (p k)) r) as [Y | Y]; [rewrite (On Y); lra | left; now apply Off]. }
  assert (Wp : weak_edge N p a b) by (left; exists o, r; split; [exact R0 |]; split; [intros k _ [-> | ->] |]; auto).
  assert (Wq : weak_edge N q a b).
  { left. exists o, r. split; [exact R0 |]. split; [| exact Qk].
    intros k K [-> | ->]; rewrite <- Stay; auto. }
  assert (Sides : exists k l, (k < N)%nat /\ (l < N)%nat /\ dist o (p k) = r /\ dist o (p l) = r /\
    orient (p a) (p b) (p k) < 0 /\ 0 < orient (p a) (p b) (p l)).
  { apply NNPP. intros Y.
    assert (Half : (forall k, (k < N)%nat -> dist o (p k) = r -> 0 <= orient (p a) (p b) (p k)) \/
      (forall l, (l < N)%nat -> dist o (p l) = r -> orient (p a) (p b) (p l) <= 0)).
    { apply NNPP. intros W. apply not_or_and in W as [W1 W2]. apply not_all_ex_not in W1 as [k W1].
      apply not_all_ex_not in W2 as [l W2]. apply imply_to_and in W1 as [K W1]. apply imply_to_and in W1 as [Ek W1].
      apply imply_to_and in W2 as [L W2]. apply imply_to_and in W2 as [El W2]. apply Y. exists k, l. repeat split; auto; lra. }
    apply Ns. destruct Half as [H | H].
    - now apply (side_is_strict N p different a b o r).
    - apply (strict_edge_sym N p), (side_is_strict N p different b a o r); auto. intros k K E. pose proof (H k K E).
      unfold orient in *. lra. }
  assert (Nq : ~ strict_edge N q a b).
  { intros [c [Ec H]]. destruct Sides as [k [l [K [L [Ek [El [Lk Ll]]]]]]].
    assert (Dis : forall m, orient (p a) (p b) (p m) <> 0 -> m <> a /\ m <> b).
    { intros m Y. split; intros ->; apply Y; unfold orient; ring. }
    destruct (Dis k ltac:(lra)) as [Ka Kb]. destruct (Dis l ltac:(lra)) as [La Lb].
    pose proof (H k K Ka Kb) as Hk. pose proof (H l L La Lb) as Hl. rewrite <- !Stay in * by auto. set (d := dist c (p a)) in *.
    assert (D0 : 0 <= d) by apply dist_nonneg.
    pose proof (radical_barycentric c d o r (p a) (p b) (p k) (p l)) as Q. unfold radical in Q.
    rewrite (power_zero o r (p a) Ea), (power_zero o r (p b) Eb), (power_zero o r (p k) Ek), (power_zero o r (p l) El) in Q.
    rewrite (power_zero c d (p a)), (power_zero c d (p b)) in Q by (reflexivity || now symmetry).
    pose proof (power_gt c d _ D0 Hk). pose proof (power_gt c d _ D0 Hl).
    assert (0 < - orient (p a) (p b) (p k) * (power c d (p l) - 0)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < orient (p a) (p b) (p l) * (power c d (p k) - 0)) by (apply Rmult_lt_0_compat; lra). lra. }
  split; split; intros; tauto.
Qed.

(* Pairs on one line of the hull. *)
Definition on_side_line (u v k : nat) : Prop := k = u \/ k = v \/ flat p q u v k.

Lemma line_pair u v a b : rim u v -> (a < N)%nat -> (b < N)%nat -> a <> b -> on_side_line u v a -> on_side_line u v b ->
  ~ strict_edge N p a b -> same_status N p q a b.
Proof.
  intros Ruv A B D La Lb Ns. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv Euv]]].
  assert (Zero : forall k, on_side_line u v k -> orient (p u) (p v) (p k) = 0).
  { intros k [-> | [-> | [Z _]]]; [unfold orient; ring | unfold orient; ring | exact Z]. }
  assert (Mid : exists k, (k < N)%nat /\ k <> a /\ k <> b /\ between (p k) (p a) (p b)).
  { apply NNPP. intros Y. apply Ns. apply (hull_pair_is_strict N p (p u) (p v) a b); auto.
    - intros k K. now apply (rim_left _ _ _ _ _ sk).
    - intros k K Da Db Bt. apply Y. now exists k. }
  destruct Mid as [k [K [Ka [Kb Bt]]]].
  assert (Third : exists m, flat p q u v m).
  { destruct La as [-> | [-> | Fl]]; [| | now exists a]; (destruct Lb as [-> | [-> | Fl]]; [| | now exists b]); try now elim D.
    - exfalso. apply (edges_are_free 0 u v k ltac:(lra) Euv K); auto. unfold x. now rewrite !at_0.
    - exfalso. apply (edges_are_free 0 u v k ltac:(lra) Euv K); auto. unfold x. rewrite !at_0.
      destruct Bt as [s [S E]]. exists (1 - s). split; [lra |]. rewrite E. apply mix_swap. }
  destruct Third as [m [_ [Su [Sv _]]]].
  assert (Stay : forall l, on_side_line u v l -> p l = q l) by (intros l [-> | [-> | [_ [_ [_ E]]]]]; auto).
  assert (Lk : on_side_line u v k).
  { destruct (Nat.eq_dec k u) as [-> | Du]; [now left |]. destruct (Nat.eq_dec k v) as [-> | Dv]; [right; now left |].
    right. right. destruct (rim_at_first N p q faces rim edge sk edges_are_free corners u v k Ruv K Du Dv) as [P | Fl];
      [exfalso | exact Fl]. rewrite !at_0 in P.
    destruct Bt as [s [S E]]. pose proof (Zero a La) as Z1. pose proof (Zero b Lb) as Z2.
    assert (orient (p u) (p v) (p k) = (1 - s) * orient (p u) (p v) (p a) + s * orient (p u) (p v) (p b))
      by (rewrite E; unfold orient, mix; simpl; ring).
    rewrite Z1, Z2 in *. lra. }
  assert (Weak : forall z : nat -> point, (forall l, on_side_line u v l -> z l = p l) ->
    (forall l, (l < N)%nat -> 0 <= orient (z u) (z v) (z l)) -> weak_edge N z a b).
  { intros z Ez Lz. right. exists (snd (p v) - snd (p u), - (fst (p v) - fst (p u))).
    exists (dot (snd (p v) - snd (p u), - (fst (p v) - fst (p u))) (p u)).
    rewrite (Ez u (or_introl eq_refl)), (Ez v (or_intror (or_introl eq_refl))) in Lz.
    assert (H : forall w, dot (snd (p v) - snd (p u), - (fst (p v) - fst (p u))) w =
      dot (snd (p v) - snd (p u), - (fst (p v) - fst (p u))) (p u) - orient (p u) (p v) w)
      by (intros w; unfold dot, orient; simpl; ring).
    split; [| split].
    - intros F. apply (different u v U V Duv). injection F as F1 F2. destruct (p u), (p v). simpl in *. f_equal; lra.
    - intros l _ [-> | ->]; rewrite Ez, H, Zero by assumption; ring.
    - intros l L. rewrite H. pose proof (Lz l L). lra. }
  assert (Wp : weak_edge N p a b) by (apply Weak; [auto | intros l L; now apply (rim_left _ _ _ _ _ sk)]).
  assert (Wq : weak_edge N q a b).
  { apply Weak; [intros l Ll; symmetry; now apply Stay |]. intros l L.
    pose proof (rim_strict_weak N p q rim 1 (rim_stays N p q faces rim edge sk edges_are_free corners) u v l Ruv L) as Y.
    now rewrite !at_1 in Y. }
  assert (Nq : ~ strict_edge N q a b).
  { intros St. apply (edge_is_free N q a b k K Ka Kb St). now rewrite <- !Stay. }
  split; split; intros; tauto.
Qed.

(* All other pairs are not edges at the end. *)
Lemma other_pair a b : (a < N)%nat -> (b < N)%nat -> a <> b -> ~ strict_edge N p a b ->
  (forall o r, tied o r -> ~ (dist o (p a) = r /\ dist o (p b) = r)) ->
  (forall u v, rim u v -> ~ (on_side_line u v a /\ on_side_line u v b)) -> ~ weak_edge N q a b.
Proof.
  intros A B D Ns Nc Nl.
  assert (No : forall i j, In (i, j) (faces a) -> b <> i /\ b <> j).
  { intros i j F. destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei [Ej _]].
    split; intros ->; [destruct (edges a i Ei) as [_ [_ [_ [X | X]]]] | destruct (edges a j Ej) as [_ [_ [_ [X | X]]]]];
      try contradiction; destruct X as [o [r [C X]]]; now apply (Nc o r C). }
  apply (others_are_no_edges N p q faces rim edge sk edges_are_free corners a b A B D No).
  - intros i j F. destruct (face_sites _ _ _ _ _ sk a i j A F) as [I [J [Dia [Dja Dij]]]].
    destruct (face_edges _ _ _ _ _ sk a i j A F) as [_ [_ Eij]]. destruct (No i j F) as [Di Dj].
    destruct (edges i j Eij) as [_ [_ [_ [St | [o [r [C [Oi Oj]]]]]]]].
    + destruct (strict_stays i j I J Dij St 1 ltac:(lra)) as [o [E H]]. exists o, (dist o (q i)).
      pose proof (H a A (not_eq_sym Dia) (not_eq_sym Dja)) as Ha. pose proof (H b B Di Dj) as Hb.
      unfold x in *. rewrite !at_1 in *. repeat split; [now symmetry | lra | lra | now left].
    + pose proof (Nc o r C) as Nab. apply tied_stays in C. exists o, r. pose proof C as [Out [Stay _]]. rewrite <- (Stay i I Oi), <- (Stay j J Oj).
      assert (Q : forall k, (k < N)%nat -> (dist o (p k) = r /\ dist o (q k) = r) \/ r < dist o (q k)).
      { intros k K. destruct (circle_stays o r k 1 C K ltac:(lra)) as [_ Off]. unfold x in *. rewrite at_1 in *.
        destruct (Req_dec (dist o (p k)) r) as [Y | Y]; [left; rewrite <- (Stay k K Y); now split | right; now apply Off]. }
      split; [exact Oi |]. split; [exact Oj |].
      destruct (Q a A) as [[P1 P2] | P]; destruct (Q b B) as [[R1 R2] | P']; lra.
  - intros u v R E Fl. apply (Nl u v R). unfold on_side_line. split; [destruct E as [-> | ->]; auto | auto].
Qed.
End Ties.
