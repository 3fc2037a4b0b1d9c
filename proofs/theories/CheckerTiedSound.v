(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A pair that the checker shows to be a tie by a set is weakly Delaunay and not strictly, wherever in their rectangles the
   sites are that the block does not describe. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Checker CheckerSound CheckerComplete CheckerCoverSound.
From Dyadel Require Import CheckerChainSound CheckerEnclosure CheckerEnclosureSound CheckerAlgebra CheckerAlgebraSound.
From Dyadel Require Import CheckerBlock CheckerBlockSound CheckerFacts CheckerFactsSound CheckerTies CheckerTiesSound CheckerTied.
Import ListNotations.
Open Scope R_scope.

(* An affine function that is 0 at a and b, and positive at k and m,
  which are on both sides of their line: there is none. *)
Lemma both_sides (px py ex ey kx ky mx my : R) : px * ex + py * ey = 0 -> 0 < px * kx + py * ky ->
  0 < px * mx + py * my ->
  0 < ex * ky - ey * kx -> ex * my - ey * mx < 0 -> False.
Proof.
  intros Z K M A B. set (n := ex * ex + ey * ey). set (q := ex * py - ey * px).
  assert (Ek : n * (px * kx + py * ky) = q * (ex * ky - ey * kx)).
  { transitivity ((px * ex + py * ey) * (ex * kx + ey * ky) + q * (ex * ky - ey * kx)); [unfold n, q;
    ring | rewrite Z; ring]. }
  assert (Em : n * (px * mx + py * my) = q * (ex * my - ey * mx)).
  { transitivity ((px * ex + py * ey) * (ex * mx + ey * my) + q * (ex * my - ey * mx)); [unfold n, q;
    ring | rewrite Z; ring]. }
  assert (N : 0 < n).
  { unfold n. pose proof (Rle_0_sqr ex) as Sx. pose proof (Rle_0_sqr ey) as Sy. unfold Rsqr in Sx, Sy.
    destruct (Req_dec (ex * ex + ey * ey) 0) as [E | E]; [| lra].
      destruct (Rplus_sqr_eq_0 ex ey) as [X Y]; [unfold Rsqr; lra |].
    rewrite X, Y in A. lra. }
  pose proof (Rmult_lt_0_compat _ _ N K) as P. pose proof (Rmult_lt_0_compat _ _ N M) as Q. rewrite Ek in P.
    rewrite Em in Q.
  destruct (Rle_lt_dec q 0) as [L | L]; [nra |].
    assert (0 < q * - (ex * my - ey * mx)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* Both ends of a segment nearer to c than a point between them: there is none.
  P, Q, C: ends and c, seen from the point. *)
Lemma between_not_farther (ex ey px py qx qy cx cy : R) : ex <> 0 \/ ey <> 0 -> ex * py - ey * px = 0 ->
  ex * qy - ey * qx = 0 ->
  px * qx + py * qy < 0 -> px * px + py * py < 2 * (px * cx + py * cy) ->
    qx * qx + qy * qy < 2 * (qx * cx + qy * cy) -> False.
Proof.
  intros E P Q M A B. set (n := ex * ex + ey * ey).
  assert (N : 0 < n).
  { unfold n. pose proof (Rle_0_sqr ex) as Sx. pose proof (Rle_0_sqr ey) as Sy. unfold Rsqr in Sx, Sy.
    destruct (Req_dec (ex * ex + ey * ey) 0) as [Z | Z]; [| lra].
      destruct (Rplus_sqr_eq_0 ex ey) as [X Y]; [unfold Rsqr; lra |].
    destruct E; contradiction. }
  assert (PQ : px * qy - py * qx = 0).
  { apply Rmult_eq_reg_l with n; [| lra]. rewrite Rmult_0_r.
    transitivity ((ex * px + ey * py) * (ex * qy - ey * qx) - (ex * qx + ey * qy) * (ex * py - ey * px)); [unfold n;
      ring |].
    rewrite P, Q. ring. }
  assert (K : (px * px + py * py) * (qx * cx + qy * cy) = (px * qx + py * qy) * (px * cx + py * cy)).
  { transitivity ((px * qx + py * qy) * (px * cx + py * cy) + (px * qy - py * qx) * (px * cy - py * cx)); [ring |].
    rewrite PQ. ring. }
  pose proof (Rle_0_sqr px) as X1. pose proof (Rle_0_sqr py) as X2. pose proof (Rle_0_sqr qx) as X3.
    pose proof (Rle_0_sqr qy) as X4.
  unfold Rsqr in *. assert (Pc : 0 < px * cx + py * cy) by lra. assert (Qc : 0 < qx * cx + qy * cy) by lra.
  assert (0 <= (px * px + py * py) * (qx * cx + qy * cy)) by (apply Rmult_le_pos; lra).
  assert (0 < - (px * qx + py * qy) * (px * cx + py * cy)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* ---- one set ---- *)

Section Sound.

Variable v : Z -> R.
Variable l : nat -> R.
Variable most D E : Z.
Variable D0 : (0 < D)%Z.
Variable g : tied_set.
Variable U : (0 < units g)%Z.
Variable St : state_ok v l (units g) (block g).

Notation ok := (known_ok l (units g)).
Notation off_left a b := (fun z : point => dx v a b * (snd z - snd (point_of v a)) - dy v a b * (fst z - fst (point_of v a))).

Lemma side_known_ok lo hi x : IZR lo <= x * unit D E <= IZR hi -> ok (side_known D E (units g) lo hi) x.
Proof.
  intros X. split; [| exact I]. pose proof (unit_pos D E D0) as P.
  assert (Sh : forall n m, (0 <= m)%Z -> IZR (Z.shiftl n m) = IZR n * powerRZ 2 m) by (intros; now apply shift_value).
  assert (Pd : (0 < Z.shiftl D (Z.max 0 E))%Z).
  { apply lt_IZR. rewrite Sh by lia. apply Rmult_lt_0_compat; [now apply IZR_lt | apply powerRZ_lt; lra]. }
  assert (Q : forall n, IZR (Z.shiftl n (Z.max 0 (- E))) / IZR (Z.shiftl D (Z.max 0 E)) = IZR n / unit D E).
  { intros n. rewrite !Sh by lia. unfold unit. pose proof (IZR_lt _ _ D0).
    assert (Pw : forall m, powerRZ 2 m <> 0) by (intros; apply powerRZ_NOR; lra).
    destruct (Z.le_ge_cases 0 E) as [C | C].
    - rewrite (Z.max_l 0 (- E)), (Z.max_r 0 E) by lia. simpl (powerRZ 2 0). field. split; [apply Pw | lra].
    - rewrite (Z.max_r 0 (- E)), (Z.max_l 0 E) by lia. rewrite powerRZ_neg'. simpl (powerRZ 2 0). field.
      split; [apply Pw | lra]. }
  apply (join_holds (units g) U) with (1 := fraction_holds (units g) _ _ Pd) (2 := fraction_holds (units g) _ _ Pd).
  rewrite !Q. split; [apply Rmult_le_reg_r with (unit D E) | apply Rmult_le_reg_r with (unit D E)]; try exact P;
    unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra; apply X.
Qed.

Lemma seen_ok x r : ok x r -> ok (seen x) r.
Proof. intros [X _]. split; [exact X | exact I]. Qed.

Lemma over_x_ok a b : ok (over_x most g a b) (dx v a b).
Proof. apply less_ok with (1 := St); apply seen_ok, number_at_ok with (1 := St). Qed.
Lemma over_y_ok a b : ok (over_y most g a b) (dy v a b).
Proof. apply less_ok with (1 := St); apply seen_ok, number_at_ok with (1 := St). Qed.

Definition in_box (h : box) (z : point) : Prop :=
  IZR (x0 h) <= fst z * unit D E <= IZR (x1 h) /\ IZR (y0 h) <= snd z * unit D E <= IZR (y1 h).

Lemma box_x_ok a h z : in_box h z -> ok (box_x most D E g a h) (fst z - fst (point_of v a)).
Proof. intros [X _]. apply less_ok with (1 := St); [now apply side_known_ok | apply number_at_ok with (1 := St)]. Qed.
Lemma box_y_ok a h z : in_box h z -> ok (box_y most D E g a h) (snd z - snd (point_of v a)).
Proof. intros [_ Y]. apply less_ok with (1 := St); [now apply side_known_ok | apply number_at_ok with (1 := St)]. Qed.

Lemma sign_is s e x : ok e x -> sign_of (within e) = s -> (s = 1%Z -> 0 < x) /\ (s = (-1)%Z -> x < 0).
Proof.
  intros [X _] S. split; intros ->; [exact (sign_positive _ U _ _ X S) | exact (sign_negative _ U _ _ X S)].
Qed.

Lemma side_of_ok a b m s : side_of most g a b m = s -> (s = 1%Z -> 0 < off_left a b (point_of v m)) /\
  (s = (-1)%Z -> off_left a b (point_of v m) < 0).
Proof.
  apply sign_is. exact (cross_ok v l most _ U _ St _ _ _ _ _ _ _ _ (over_x_ok a b) (over_y_ok a b) (over_x_ok a m) (over_y_ok a m)).
Qed.

Lemma between_ok a b m : is_between most g a b m = true -> dx v m a * dx v m b + dy v m a * dy v m b < 0.
Proof.
  intros K. unfold is_between in K. apply Z.eqb_eq in K. refine (proj2 (sign_is _ _ _ _ K) eq_refl).
  apply sum_with_ok with (1 := St); apply product_with_ok with (2 := St); auto using over_x_ok, over_y_ok.
Qed.

(* ---- where boxes are ---- *)

Lemma where_line a b f h z : says g = OnLine a b f -> in_box h z ->
  (where_is most D E g h = 1%Z -> 0 < off_left a b z) /\ (where_is most D E g h = (-1)%Z -> off_left a b z < 0).
Proof.
  intros F Z. unfold where_is. rewrite F. cbv zeta. refine (sign_is _ _ _ _ eq_refl).
  exact (cross_ok v l most _ U _ St _ _ _ _ _ _ _ _ (over_x_ok a b) (over_y_ok a b) (box_x_ok a h z Z) (box_y_ok a h z Z)).
Qed.

Lemma product_of_signs e f x y : ok e x -> ok f y -> (sign_of (within e) * sign_of (within f) = 1)%Z -> 0 < x * y.
Proof.
  intros X Y H. destruct (sign_cases (within e)) as [S | [S | S]], (sign_cases (within f)) as [T | [T | T]]; rewrite S, T in H;
    try discriminate H; destruct (sign_is _ _ _ X S) as [Xp Xn], (sign_is _ _ _ Y T) as [Yp Yn].
  - apply Rmult_lt_0_compat; auto.
  - specialize (Xn eq_refl). specialize (Yn eq_refl). nra.
Qed.

Lemma where_circle a b c f h z : says g = OnCircle a b c f -> in_box h z -> where_is most D E g h = 1%Z ->
  0 < off_at v a b c z * (dx v a b * dy v a c - dy v a b * dx v a c).
Proof.
  intros F Z. unfold where_is. rewrite F. cbv zeta. apply product_of_signs.
  - exact (off_ok v l most _ U _ St a b c _ _ z (box_x_ok a h z Z) (box_y_ok a h z Z)).
  - exact (cross_ok v l most _ U _ St _ _ _ _ _ _ _ _ (step_x_ok v l most _ _ St a b) (step_y_ok v l most _ _ St a b)
      (step_x_ok v l most _ _ St a c) (step_y_ok v l most _ _ St a c)).
Qed.

(* ---- a choice, in which the members are where the block says ---- *)

Variable sites : list site.
Variable edges : list edge.
Variable B : nat -> rect.
Variable C : check D E sites edges = true.
Variable F : describes sites B.
Variable bs : list box.
Variable Sc : scaled_sites D E sites = Some bs.
Variable p : nat -> point.
Variable P : choice (length sites) B p.
Variable At : forall k m, In m (members g) -> named sites k (fst m) -> p k = point_of v (snd m).

Lemma choice_in_box k b : nth_error bs k = Some b -> (k < length sites)%nat -> in_box b (p k) /\ exists s,
  nth_error sites k = Some s /\ name s = box_name b.
Proof.
  intros T K. destruct (box_of D E sites B F k K bs Sc D0) as (s & b' & S & T' & N & (X0 & X1 & Y0 & Y1) & _).
  assert (b' = b) by congruence. subst b'. destruct (P k K) as [X Y]. pose proof (unit_pos D E D0). unfold in_box.
  rewrite X0, X1, Y0, Y1. split; [| now exists s].
  split; split; apply Rmult_le_compat_r; lra.
Qed.

Lemma covered_in h b z : covers h b -> in_box b z -> in_box h z.
Proof.
  intros (X0 & X1 & Y0 & Y1) [X Y]. apply IZR_le in X0, X1, Y0, Y1. unfold in_box. lra.
Qed.

(* Each site is a member, or all of a box is there that it is in. *)
Lemma all_are_ok z k : all_are most D E g (build deepest bs) z = true -> (k < length sites)%nat ->
  (exists m, In m (members g) /\ named sites k (fst m)) \/ exists h, in_box h (p k) /\ where_is most D E g h = z.
Proof.
  intros A K. unfold all_are in A. cbv zeta in A.
  destruct (nth_error bs k) as [b |] eqn:T; [| apply nth_error_None in T; rewrite (scaled_sites_length D E sites bs Sc) in T; lia].
  destruct (choice_in_box k b T K) as [Z (s & S & N)].
  destruct (all_in_or _ _ b _ _ A (nth_error_In _ _ T)) as [H | (h & Cv & H)].
  - apply orb_prop in H as [H | H]; [left | right; exists b; split; [exact Z | now apply Z.eqb_eq]].
    destruct (Map.find (box_name b) (index fst (members g))) as [m |] eqn:M.
    + apply index_in in M as [M Q]. exists m. split; [exact M |]. exists s. split; [exact S | congruence].
    + apply Map.mem_2 in H as [m H]. apply Map.find_1 in H. congruence.
  - right. exists h. split; [exact (covered_in h b _ Cv Z) | now apply Z.eqb_eq].
Qed.

Lemma member_place m : In m (members g) -> In (snd m) (places_of (says g)).
Proof. intros M. destruct m as [i q]. exact (in_combine_r _ _ _ _ M). Qed.

(* The line, or the circle, of all members. *)
Definition on_set (z : point) : Prop :=
  match says g with Same _ _ => False | OnLine a b _ => off_left a b z = 0 | OnCircle a b c _ => off_at v a b c z = 0 end.

Lemma set_weak i j mi mj : is_free most D E g (build deepest bs) = true ->
  In mi (members g) -> named sites i (fst mi) -> In mj (members g) -> named sites j (fst mj) -> weak_edge (length sites) p i j.
Proof.
  intros Fr Mi Ni Mj Nj. unfold is_free in Fr. apply andb_prop in Fr as [Fact Fr].
  pose proof (At i mi Mi Ni) as Pi. pose proof (At j mj Mj Nj) as Pj.
  pose proof (member_place mi Mi) as Qi. pose proof (member_place mj Mj) as Qj.
  destruct (says g) as [a b | a b f | a b c f] eqn:Sg; [discriminate | |].
  - right. destruct (fact_holds_ok v l most _ U _ St _ Fact) as [Df On].
    assert (OnIt : forall q, In q (places_of (OnLine a b f)) -> off_left a b (point_of v q) = 0).
    { cbv beta. intros q [<- | [<- | I]]; [ring | unfold dx, dy; ring | exact (On q I)]. }
    assert (S : exists s : R, s * s = 1 /\ forall k, (k < length sites)%nat -> 0 <= s * off_left a b (p k)).
    { apply orb_prop in Fr as [Fr | Fr]; [exists 1 | exists (-1)]; (split; [lra |]); intros k K;
        (destruct (all_are_ok _ k Fr K) as [(m & M & N) | (h & Zh & W)];
          [rewrite (At k m M N), OnIt; [lra | rewrite <- Sg; now apply member_place] |]);
        destruct (where_line a b f h (p k) Sg Zh) as [W1 W2];
        [specialize (W1 W); lra | specialize (W2 W); lra]. }
    destruct S as (s & S1 & S). assert (S0 : s <> 0) by (intros ->; lra).
    exists (s * dy v a b, - s * dx v a b), (dot (s * dy v a b, - s * dx v a b) (point_of v a)). split; [| split].
    + intros Z. injection Z as Zx Zy. apply Df. assert (dy v a b = 0) by (apply Rmult_eq_reg_l with s; lra).
      assert (dx v a b = 0) by (apply Rmult_eq_reg_l with s; lra). unfold dx, dy in *. 
      destruct (point_of v a), (point_of v b). simpl in *. f_equal; lra.
    + intros k _ T. assert (Z : off_left a b (p k) = 0).
      { destruct T as [-> | ->]; [rewrite Pi | rewrite Pj]; now apply OnIt. }
      unfold dot. cbn [fst snd]. assert (s * off_left a b (p k) = 0) by (rewrite Z; ring). cbv beta in *. lra.
    + intros k K. pose proof (S k K). unfold dot. cbn [fst snd]. cbv beta in *. lra.
  - left. destruct (circle_holds_ok v l most _ U _ St _ _ _ _ Fact) as [N0 (o & r & R0 & Off & On)].
    assert (OnIt : forall q, In q (places_of (OnCircle a b c f)) -> dist2 o (point_of v q) = r).
    { intros q [<- | [<- | [<- | I]]]; apply On; tauto. }
    exists o, (dist o (p i)). 
    assert (Di : dist2 o (p i) = r) by (rewrite Pi; now apply OnIt). split; [| split].
    + rewrite <- dist_sq in Di. pose proof (dist_nonneg o (p i)).
      destruct (Req_dec (dist o (p i)) 0) as [Z | Z]; [rewrite Z in Di; lra | lra].
    + intros k _ [-> | ->]; [reflexivity |]. apply dist_eq. rewrite Di, Pj. now apply OnIt.
    + intros n Kn. apply dist_le. rewrite Di. destruct (all_are_ok _ n Fr Kn) as [(m & M & N) | (h & Zh & W)].
      * rewrite (At n m M N). right. symmetry. apply OnIt. rewrite <- Sg. now apply member_place.
      * pose proof (where_circle a b c f h (p n) Sg Zh W) as G. rewrite Off in G.
        set (q := dx v a b * dy v a c - dy v a b * dx v a c) in *.
        assert (0 < q * q) by nra. left. apply Rmult_lt_reg_l with (q * q); [assumption |]. nra.
Qed.

Lemma set_not_strict i j k n mi mj mk mn : is_free most D E g (build deepest bs) = true ->
  In mi (members g) -> named sites i (fst mi) -> In mj (members g) -> named sites j (fst mj) ->
  In mk (members g) -> named sites k (fst mk) -> In mn (members g) -> named sites n (fst mn) ->
  k <> i -> k <> j -> n <> i -> n <> j ->
  is_crossed most g (snd mi) (snd mj) (snd mk) (snd mn) = true -> ~ strict_edge (length sites) p i j.
Proof.
  intros Fr Mi Ni Mj Nj Mk Nk Mn Nn Ki Kj Hi Hj Cr (c & Eq & Out).
  assert (Below : forall t z, named sites t z -> (t < length sites)%nat).
  { intros t z (s & S & _). apply nth_error_Some. congruence. }
  pose proof (Out k (Below _ _ Nk) Ki Kj) as Ck. pose proof (Out n (Below _ _ Nn) Hi Hj) as Cn.
  apply dist_eq in Eq. apply dist_lt in Ck, Cn. rewrite (At i mi Mi Ni), ?(At j mj Mj Nj) in *.
  rewrite (At k mk Mk Nk) in Ck. rewrite (At n mn Mn Nn) in Cn.
  unfold is_free in Fr. apply andb_prop in Fr as [Fact _]. unfold is_crossed in Cr.
  pose proof (member_place _ Mi) as Qi. pose proof (member_place _ Mj) as Qj. pose proof (member_place _ Mk) as Qk.
  pose proof (member_place _ Mn) as Qn.
  destruct (says g) as [a b | a b f | a b d f]; [discriminate | |].
  - destruct (fact_holds_ok v l most _ U _ St _ Fact) as [Df On]. apply between_ok in Cr.
    assert (OnIt : forall q, In q (places_of (OnLine a b f)) -> off_left a b (point_of v q) = 0).
    { cbv beta. intros q [<- | [<- | I]]; [ring | unfold dx, dy; ring | exact (On q I)]. }
    apply OnIt in Qi, Qj, Qk. cbv beta in Qi, Qj, Qk.
    refine (between_not_farther (dx v a b) (dy v a b) _ _ _ _ (fst c - fst (point_of v (snd mk)))
      (snd c - snd (point_of v (snd mk))) _ _ _ Cr _ _); unfold dist2 in *; try (unfold dx, dy in *; lra).
    destruct (Req_dec (dx v a b) 0) as [X | X]; [| now left]. right. intros Y. apply Df. unfold dx, dy in *.
    destruct (point_of v a), (point_of v b). simpl in *. f_equal; lra.
  - destruct (circle_holds_ok v l most _ U _ St _ _ _ _ Fact) as [_ (o & r & _ & _ & On)].
    assert (OnIt : forall q, In q (places_of (OnCircle a b d f)) -> dist2 o (point_of v q) = r).
    { intros q [<- | [<- | [<- | I]]]; apply On; tauto. }
    apply OnIt in Qi, Qj, Qk, Qn. apply andb_prop in Cr as [Sk Sn]. apply Z.eqb_eq in Sk, Sn.
    apply side_of_ok in Sk as [Sk _]. apply side_of_ok in Sn as [_ Sn]. specialize (Sk eq_refl). specialize (Sn eq_refl).
    unfold dx, dy, dist2 in *.
    refine (both_sides (fst o - fst c) (snd o - snd c) _ _ _ _ _ _ _ _ _ Sk Sn); lra.
Qed.

End Sound.

(* ---- all of them ---- *)

(* In the choice p, the members are where numbers say that the block describes. *)
Definition is_there (l : list site) (p : nat -> point) (g : tied_set) : Prop :=
  exists v leaf, (0 < units g)%Z /\ state_ok v leaf (units g) (block g) /\
    forall k m, In m (members g) -> named l k (fst m) -> p k = point_of v (snd m).

Lemma free_sets_in most D E t sets n g own : Map.find n (free_sets most D E t sets) = Some (g, own) ->
  (exists k, In (k, g) sets) /\ is_free most D E g t = true /\ own = index fst (members g).
Proof.
  unfold free_sets. assert (G : forall found, Map.find n (fold_left (fun found s => if is_free most D E (snd s) t
      then Map.add (fst s) (snd s, index fst (members (snd s))) found else found) sets found) = Some (g, own) ->
    (exists k, In (k, g) sets) /\ is_free most D E g t = true /\ own = index fst (members g) \/ Map.find n found = Some (g, own)).
  { induction sets as [| [k h] sets IH]; intros found H; [now right |]. simpl in H. apply IH in H as [((k' & I) & R) | H].
    - left. split; [exists k'; now right | exact R].
    - destruct (is_free most D E h t) eqn:Fr; [| now right]. destruct (Z.eq_dec k n) as [Q | Q].
      + pose proof (Map.find_1 (Map.add_1 found (h, index fst (members h)) Q)) as M. rewrite M in H. injection H as <- <-.
        left. split; [exists k; now left | now split].
      + right. apply Map.find_1. exact (Map.add_3 Q (Map.find_2 H)). }
  intros H. destruct (G _ H) as [R | R]; [exact R |]. destruct (Map.empty_1 (Map.find_2 R)).
Qed.

Theorem set_tie_every_choice most D E l edges B sets hint pairs e a b p :
  check D E l edges = true -> describes l B -> choice (length l) B p -> (forall k g, In (k, g) sets -> is_there l p g) ->
  In e pairs -> ~ In e (loose_of_sets most D E l sets hint pairs) -> named l a (from e) -> named l b (to e) ->
  weak_edge (length l) p a b /\ ~ strict_edge (length l) p a b.
Proof.
  intros C F P There I H Na Nb. destruct (accepted_parts D E l edges C) as (bs & Sc & P0 & _). 
  unfold loose_of_sets in H. rewrite Sc in H. cbv zeta in H.
  match type of H with ~ In e (kept ?f pairs) => destruct (f e) eqn:K; [destruct H; now apply in_kept |] end.
  clear H. apply negb_false_iff, existsb_exists in K as (h & _ & K). unfold set_tie in K. cbv zeta in K.
  destruct (Map.find (by_set h) _) as [[g own] |] eqn:Fg; [| discriminate].
  apply free_sets_in in Fg as ((n & Ig) & Fr & ->). destruct (There n g Ig) as (v & leaf & U & St & At).
  assert (Q : forall i m, (if Map.mem i (index box_name bs) then Map.find i (index fst (members g)) else None) = Some m ->
    In m (members g) /\ fst m = i /\ exists k, named l k i).
  { intros i m X. destruct (Map.mem i (index box_name bs)) eqn:M; [| discriminate]. apply index_in in X as [X Y].
    split; [exact X |]. split; [exact Y |]. apply Map.mem_2 in M as [bx M]. apply Map.find_1 in M.
    apply (sought_box D E l edges C bs Sc) in M. exists (position bs i). exact (proj1 (found_named D E l edges B C F bs Sc i bx M)). }
  destruct (if Map.mem (from e) _ then _ else None) as [ma |] eqn:Fa; [| now rewrite andb_false_r in K].
  destruct (if Map.mem (to e) _ then _ else None) as [mb |] eqn:Fb; [| now rewrite andb_false_r in K].
  destruct (if Map.mem (one_side h) _ then _ else None) as [mk |] eqn:Fk; [| now rewrite andb_false_r in K].
  destruct (if Map.mem (other_side h) _ then _ else None) as [mn |] eqn:Fn; [| now rewrite andb_false_r in K].
  apply Q in Fa as (Ma & Ea & _), Fb as (Mb & Eb & _), Fk as (Mk & Ek & k & Nk), Fn as (Mn & En & n' & Nn).
  rewrite !andb_true_iff in K. destruct K as [[Ok On] Cr]. unfold is_other in Ok, On.
  rewrite andb_true_iff, !negb_true_iff, !Z.eqb_neq in Ok, On.
  assert (Apart : forall s t i j, named l s i -> named l t j -> i <> j -> s <> t).
  { intros s t i j (x & X & Nx) (y & Y & Ny) N ->. congruence. }
  destruct Ok as [Ok1 Ok2], On as [On1 On2].
  pose proof (Apart _ _ _ _ Nk Na Ok1). pose proof (Apart _ _ _ _ Nk Nb Ok2). pose proof (Apart _ _ _ _ Nn Na On1).
  pose proof (Apart _ _ _ _ Nn Nb On2). rewrite <- Ea in Na. rewrite <- Eb in Nb. rewrite <- Ek in Nk. rewrite <- En in Nn. split.
  - exact (set_weak v leaf most D E P0 g U St l B F bs Sc p P At a b ma mb Fr Ma Na Mb Nb).
  - exact (set_not_strict v leaf most D E g U St l bs p At a b k n' ma mb mk mn Fr Ma Na Mb Nb Mk Nk Mn Nn
      ltac:(assumption) ltac:(assumption) ltac:(assumption) ltac:(assumption) Cr).
Qed.

(* However narrower the rectangles are, as long as they hold the points that blocks describe: the pair is possible, and not
   legal. *)
Theorem set_tie_stays most D E l edges B B' sets hint pairs e a b p :
  check D E l edges = true -> describes l B -> refined (length l) B' B -> choice (length l) B' p ->
  (forall k g, In (k, g) sets -> is_there l p g) ->
  In e pairs -> ~ In e (loose_of_sets most D E l sets hint pairs) -> named l a (from e) -> named l b (to e) ->
  possible (length l) B' a b /\ ~ legal (length l) B' a b.
Proof.
  intros C F Q P There I H Na Nb.
  assert (Below : forall t z, named l t z -> (t < length l)%nat).
  { intros t z (s & S & _). apply nth_error_Some. congruence. }
  apply (tied_by_choice _ B B' a b p (Below _ _ Na) (Below _ _ Nb) Q P). intros P'.
  exact (set_tie_every_choice most D E l edges B sets hint pairs e a b p C F P' There I H Na Nb).
Qed.
